//! Texts of the ranking: which system suits the façade.

texts! {
    const CHOOSE = "Ranking" | "Rang";
    const CHOOSE_HELP = "Ranks the products of the catalogue for this façade by an annual simulation of this room, with objectives and weights." | "Bewertet die Produkte des Katalogs für diese Fassade durch eine Jahressimulation dieses Raums, mit Zielen und Gewichten.";
    const CHOOSE_ABOUT = "Products of the catalogue, ranked by an annual simulation of this room with objectives and weights. Scores that differ within the uncertainty share a rank. Changed weights and scale limits reorder known results; nothing is computed again.\nDiamond: Pareto-optimal. Double tilde: approximate figures. Roof: currently in the room.\nSource: weighted sum of objectives between scale limits, with intervals; Pareto front; IEA SHC Task 31 report (2005), figure 18." | "Produkte des Katalogs, bewertet durch eine Jahressimulation dieses Raums mit Zielen und Gewichten. Nutzwerte, die sich innerhalb der Unsicherheit unterscheiden, teilen einen Rang. Geänderte Gewichte und Skalengrenzen ordnen bekannte Ergebnisse neu; nichts wird erneut berechnet.\nRaute: Pareto-optimal. Doppelte Tilde: Kennwerte als Näherung. Dach: zurzeit im Raum.\nQuelle: gewichtete Summe der Ziele zwischen Skalengrenzen, mit Intervallen; Pareto-Front; Bericht IEA SHC Task 31 (2005), Bild 18.";

    // Before there is a ranking.
    const INVITATION = "Which system of the catalogue suits this façade? An annual simulation of this room, with the control of each product, ranks them by your objectives. Coarse results come first and are then refined." | "Welches System des Katalogs passt zu dieser Fassade? Eine Jahressimulation dieses Raums, mit der Steuerung jedes Produkts, bewertet sie nach Ihren Zielen. Grobe Ergebnisse kommen zuerst und werden dann verfeinert.";
    const RANK_CATALOGUE = "Rank the catalogue for this façade" | "Katalog für diese Fassade bewerten";
    const RANK_TIP = "Runs in the background and can be stopped; results so far are kept" | "Läuft im Hintergrund und lässt sich anhalten; bisherige Ergebnisse bleiben";
    fn would_count(names) = "Objectives: {names}" | "Ziele: {names}";
    const ADDED_OBJECTIVES = "Default objectives were added to the scene; change them in the Ranking tile" | "Vorgabeziele wurden der Szene hinzugefügt; in der Kachel Rang zu ändern";
    const LANE_RANK = "ranking" | "Rangfolge";
    const STOPPED = "Ranking stopped; results so far are kept" | "Bewertung angehalten; bisherige Ergebnisse bleiben";
    const NO_RANKING = "there is no ranking yet; compute one in the Ranking tile first" | "es gibt noch keine Rangfolge; zuerst eine in der Kachel Rang berechnen";
    const NO_APERTURE = "The room has no aperture for a product: add one in the scene panel" | "Der Raum hat keine Öffnung für ein Produkt: im Szenenbereich eine hinzufügen";
    const NO_PRODUCTS = "No product matches; change the search of the catalogue, or rank all" | "Kein Produkt passt; die Suche im Katalog ändern oder alle bewerten";
    const PREPARING = "weather and products" | "Wetter und Produkte";
    const STOP = "Stop" | "Anhalten";
    const STOP_TIP = "Stops the computation and keeps the results, so that Continue can resume it" | "Hält die Rechnung an und behält die Ergebnisse, sodass Fortsetzen sie wieder aufnimmt";
    const AGAIN = "Rank again" | "Neu bewerten";
    const AGAIN_TIP = "Recomputes the ranking for the changed scene, catalogue or search; only products without results are computed" | "Berechnet die Rangfolge für geänderte Szene, Katalog oder Suche; nur Produkte ohne Ergebnisse werden gerechnet";
    const CONTINUE = "Continue" | "Fortsetzen";
    fn unfinished(left) = "{left} products still need refining with sharp beams" | "{left} Produkte sind noch mit scharfen Bündeln zu verfeinern";
    const FIND_FIGURE = "Compute" | "Berechnen";
    const FIND_FIGURE_TIP = "Computes the figure of an objective that some products lack" | "Berechnet den Kennwert eines Ziels, der einigen Produkten fehlt";
    fn done(done, all) = "{done} of {all} products" | "{done} von {all} Produkten";
    fn by_cells(done, all) = "{done} of {all} products, coarse" | "{done} von {all} Produkten, grob";
    fn left(done, seconds) = "{done}, {seconds} s left" | "{done}, noch {seconds} s";

    // Table and plot.
    const TABLE = "Products" | "Produkte";
    const TABLE_TIP = "Lists the products with bars of their scores" | "Listet die Produkte mit Balken für ihren Nutzwert";
    const PLOT = "Plot" | "Diagramm";
    const PLOT_TIP = "Plots two objectives against each other" | "Zeigt zwei Ziele übereinander";
    const OBJECTIVES = "Objectives" | "Ziele";
    const OBJECTIVES_TIP = "Edits objectives, weights and scale limits" | "Ändert Ziele, Gewichte und Skalengrenzen";
    const LIST_NAME = "Ranked products; arrow keys select, Enter puts one into the room" | "Rangfolge der Produkte; Pfeiltasten wählen, Eingabe setzt eines in den Raum";
    fn order_by(name) = "Sort by {name}" | "Sortieren nach {name}";
    fn shown(shown, all) = "{shown} of {all} shown" | "{shown} von {all} gezeigt";
    const FILTER = "filter" | "filtern";
    const FILTER_TIP = "Shows only products with these words in their names" | "Zeigt nur Produkte mit diesen Wörtern im Namen";
    const FRONT_ONLY = "Pareto only" | "nur Pareto";
    const FRONT_TIP = "Shows only Pareto-optimal products: no other is better in every objective" | "Zeigt nur Pareto-optimale Produkte: kein anderes ist in jedem Ziel besser";
    fn excluded_too(count) = "excluded ({count})" | "ausgeschlossen ({count})";
    const EXCLUDED_TIP = "Shows the excluded products too, with the reason" | "Zeigt auch ausgeschlossene Produkte, mit dem Grund";
    const PLOT_NAME = "Two objectives" | "Zwei Ziele";
    const PLOT_FOOT = "Point at a product for its figures; click for the reasons of its rank" | "Auf ein Produkt zeigen für seine Kennwerte; anklicken für die Gründe seines Rangs";
    const ACROSS = "x axis" | "x-Achse";
    const UP = "y axis" | "y-Achse";
    const RANK = "Rank" | "Rang";
    const RANK_TIP_HEAD = "Place in the order; a range where scores differ within the uncertainty" | "Platz in der Rangfolge; ein Bereich, wo sich Nutzwerte innerhalb der Unsicherheit unterscheiden";
    fn rank_is(rank) = "rank {rank}" | "Rang {rank}";
    const PRODUCT = "Product" | "Produkt";
    const SCORE = "Score" | "Nutzwert";
    const SCORE_TIP = "Weighted mean of the objectives: 0 at their worst values, 1 at their best; the line is its uncertainty" | "Gewichtetes Mittel der Ziele: 0 bei ihren schlechtesten, 1 bei ihren besten Werten; der Strich ist die Unsicherheit";
    fn score(value, error) = "score {value} ± {error}" | "Nutzwert {value} ± {error}";
    const LESS_IS_BETTER = "less is better" | "weniger ist besser";
    const MORE_IS_BETTER = "more is better" | "mehr ist besser";
    const MARKS_TIP = "◆ Pareto-optimal · ≈ approximate · ⌂ in the room; pale: preliminary, from patch-averaged data" | "◆ Pareto-optimal · ≈ Näherung · ⌂ im Raum; blass: vorläufig, mit über Felder gemittelten Daten";
    const COARSE_TIP = "Preliminary, from patch-averaged data, which blur direct sun; results with sharp beams follow" | "Vorläufig, mit über Felder gemittelten Daten, die direktes Sonnenlicht verwischen; Ergebnisse mit scharfen Bündeln folgen";
    fn approximate_since(reasons) = "Approximate: {reasons}" | "Näherung: {reasons}";

    // Reasons of the ranking, and what can be done next.
    const CHOOSE_ONE = "Select a product for the reasons of its rank; a double click puts it into the room" | "Ein Produkt wählen für die Gründe seines Rangs; ein Doppelklick setzt es in den Raum";
    const ONLY_ONE = "There is no other product to compare it with" | "Es gibt kein anderes Produkt zum Vergleichen";
    const AGAINST = "against" | "gegen";
    const AGAINST_TIP = "Selects the product to compare with; Shift and a click on a row does the same" | "Wählt das Produkt zum Vergleichen; Umschalt und ein Klick auf eine Zeile tut dasselbe";
    const THE_BEST = "the best" | "das beste";
    fn surely_above(score, other) = "{score} higher than {other}" | "um {score} höher als {other}";
    fn surely_below(score, other) = "{score} lower than {other}" | "um {score} niedriger als {other}";
    fn open_above(score, other) = "{score} higher than {other}, within the uncertainty" | "um {score} höher als {other}, innerhalb der Unsicherheit";
    fn open_below(score, other) = "{score} lower than {other}, within the uncertainty" | "um {score} niedriger als {other}, innerhalb der Unsicherheit";
    fn by_objective(score, name, own, other) = "{score} by {name}: {own} against {other}" | "{score} durch {name}: {own} gegen {other}";
    fn part_is(value, when) = "{value} in {when}" | "{value} bei {when}";
    const INTO_ROOM = "Put into the room" | "In den Raum setzen";
    const INTO_ROOM_TIP = "Replaces the system in the room by this product; undo restores it" | "Ersetzt das System im Raum durch dieses Produkt; Rückgängig stellt es wieder her";
    const ADD_TO_COMPARISON = "Add to comparison" | "Zum Vergleich";
    const ADD_TO_COMPARISON_TIP = "Adds this product to the comparison" | "Fügt dieses Produkt dem Vergleich hinzu";
    fn excluded_because(reason) = "Excluded: {reason}" | "Ausgeschlossen: {reason}";

    // Objectives.
    const WEIGHT_TIP = "Weight of the objective, relative to the others" | "Gewicht des Ziels, im Verhältnis zu den anderen";
    fn weight_of(name) = "Weight of {name}" | "Gewicht von {name}";
    const WORST = "Worst value" | "Schlechtester Wert";
    const WORST_TIP = "Value of the figure that scores 0; worse values score 0 too" | "Kennwert, der 0 ergibt; schlechtere ergeben ebenfalls 0";
    fn worst_of(name) = "Worst value of {name}" | "Schlechtester Wert von {name}";
    const BEST = "Best value" | "Bester Wert";
    const BEST_TIP = "Value of the figure that scores 1; better values score 1 too" | "Kennwert, der 1 ergibt; bessere ergeben ebenfalls 1";
    fn best_of(name) = "Best value of {name}" | "Bester Wert von {name}";
    fn leave_out(name) = "Remove {name}" | "{name} entfernen";
    const LEAVE_OUT_TIP = "Removes the objective; its figures are kept" | "Entfernt das Ziel; seine Kennwerte bleiben";
    const ADD_OBJECTIVE = "Add an objective" | "Ziel hinzufügen";
    const ADD_OBJECTIVE_TIP = "Adds a figure of the annual simulation as an objective" | "Fügt einen Kennwert der Jahressimulation als Ziel hinzu";
    const FIGURE_KNOWN = "Known for all products: ranks at once" | "Für alle Produkte bekannt: sofort bewertet";
    const FIGURE_TO_COMPUTE = "Has to be computed for all products" | "Für alle Produkte noch zu berechnen";
    fn to_compute(name) = "{name} (to be computed)" | "{name} (zu berechnen)";
    const IN_SEARCH = "only search results" | "nur Suchergebnisse";
    fn in_search(count) = "only search results ({count})" | "nur Suchergebnisse ({count})";
    const IN_SEARCH_TIP = "Ranks only the products that search and filters of the catalogue list now" | "Bewertet nur die Produkte, die Suche und Filter des Katalogs jetzt zeigen";
    const APERTURE = "Aperture to rank for" | "Öffnung der Bewertung";
    const APERTURE_TIP = "Selects the aperture that the products are put into" | "Wählt die Öffnung, in die die Produkte gesetzt werden";
    const ALL_APERTURES = "all with a catalogue product" | "alle mit Katalogprodukt";
    fn aperture(number) = "aperture {number}" | "Öffnung {number}";
    fn weather_is(name) = "Weather: {name}" | "Wetter: {name}";

    // Parts of figures.
    const WINTER = "winter" | "Winter";
    const SPRING = "spring" | "Frühling";
    const SUMMER = "summer" | "Sommer";
    const AUTUMN = "autumn" | "Herbst";
    const SUN = "sun" | "Sonne";
    const NO_SUN = "no sun" | "ohne Sonne";
    const FRONT = "front" | "vorn";
    const REAR = "rear" | "hinten";
    const WHOLE_ROOM = "whole room" | "ganzer Raum";
    const ELSEWHERE = "elsewhere" | "anderswo";
}

/// Returns season, sun or zone of a part in the current language; an unknown word unchanged.
pub fn part_word(word: &str) -> &str {
    let known = [WINTER, SPRING, SUMMER, AUTUMN, SUN, NO_SUN, FRONT, REAR, WHOLE_ROOM, ELSEWHERE];
    known.into_iter().find(|text| text.english() == word).map_or(word, |text| text.get())
}
