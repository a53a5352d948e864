//! Texts of the ranking: which system suits the façade.

texts! {
    // Figures that may be objectives.
    const LIGHTING_ENERGY = "Lighting energy" | "Energie der Beleuchtung";
    const USEFUL_LIGHT = "Useful light, 300–3000 lx" | "Nützliches Licht, 300–3000 lx";
    const TOO_MUCH_LIGHT = "Too much light, over 3000 lx" | "Zu viel Licht, über 3000 lx";
    const TOO_LITTLE_LIGHT = "Too little light, under 100 lx" | "Zu wenig Licht, unter 100 lx";
    const SOME_LIGHT = "Some light, 100–300 lx" | "Etwas Licht, 100–300 lx";
    const CONTINUOUS_AUTONOMY = "Continuous autonomy, 300 lx" | "Stetige Autonomie, 300 lx";
    const AUTONOMY_300 = "Autonomy, 300 lx" | "Autonomie, 300 lx";
    const AUTONOMY_500 = "Autonomy, 500 lx" | "Autonomie, 500 lx";
    const SPATIAL_AUTONOMY = "Area with autonomy, 300 lx" | "Fläche mit Autonomie, 300 lx";
    const SUN_EXPOSURE = "Area with much sun" | "Fläche mit viel Sonne";
    const SUN_HOURS = "Hours of sun" | "Sonnenstunden";
    const MOVEMENTS = "Movements" | "Bewegungen";
    const MEAN_LIGHT = "Mean illuminance" | "Mittlere Beleuchtungsstärke";
    const SUMMER_SUN = "Solar energy in summer" | "Sonnenenergie im Sommer";
    fn glare_of(eye) = "Glare at eye {eye}" | "Blendung an Auge {eye}";
    fn simple_glare_of(eye) = "Glare at eye {eye}, simplified" | "Blendung an Auge {eye}, vereinfacht";

    const CHOOSE = "Choose" | "Wählen";
    const CHOOSE_HELP = "Which system for this façade: the products of the catalogue through a year in this room, put in order by objectives and weights." | "Welches System für diese Fassade: die Produkte des Katalogs durch ein Jahr in diesem Raum, gereiht nach Zielen und Gewichten.";
    const CHOOSE_ABOUT = "Products of the catalogue in this room, through a year, by objectives and weights. What the errors cannot tell apart shares a rank. Weights and anchors order anew what is known; nothing is computed again.\nA diamond: no other is better in every objective. A double tilde: approximate figures. A roof: in the room now.\nSource: weighted sum of objectives between anchors, with intervals; Pareto front; IEA SHC Task 31 report (2005), figure 18." | "Produkte des Katalogs in diesem Raum, durch ein Jahr, nach Zielen und Gewichten. Was die Unsicherheiten nicht trennen, teilt einen Rang. Gewichte und Anker ordnen neu, was bekannt ist; nichts wird noch einmal gerechnet.\nEine Raute: keines ist in jedem Ziel besser. Eine doppelte Tilde: Kennwerte als Näherung. Ein Dach: jetzt im Raum.\nQuelle: gewichtete Summe der Ziele zwischen Ankern, mit Intervallen; Pareto-Front; Bericht IEA SHC Task 31 (2005), Bild 18.";

    // Before there is a ranking.
    const INVITATION = "Which of the catalogue's systems suits this façade? Each works a year in this room, under its own control; what counts is yours to say. The first results are coarse and come soon, finer ones follow." | "Welches System des Katalogs passt zu dieser Fassade? Jedes arbeitet ein Jahr in diesem Raum, mit eigener Regelung; was zählt, lässt sich festlegen. Erste, grobe Ergebnisse kommen bald, feinere folgen.";
    const RANK_CATALOGUE = "Rank the catalogue for this façade" | "Den Katalog für diese Fassade reihen";
    const RANK_TIP = "Goes on beside your work, and can be stopped; what was found stays" | "Läuft neben der Arbeit her und lässt sich anhalten; Gefundenes bleibt";
    fn would_count(names) = "What counts: {names}" | "Was zählt: {names}";
    const ADDED_OBJECTIVES = "Usual objectives were put into the scene; change them in the Choose tile" | "Übliche Ziele wurden in die Szene gesetzt; in der Kachel Wählen zu ändern";
    const LANE_RANK = "ranking" | "Reihung";
    const STOPPED = "The ranking was stopped; what was found stays" | "Die Reihung wurde angehalten; Gefundenes bleibt";
    const NO_RANKING = "there is no ranking yet; make one in the Choose tile first" | "es gibt noch keine Reihung; zuerst eine in der Kachel Wählen machen";
    const NO_APERTURE = "The room has no aperture that a product could fill" | "Der Raum hat keine Öffnung, die ein Produkt füllen könnte";
    const NO_PRODUCTS = "No product is found; change the catalogue's search, or rank all" | "Kein Produkt gefunden; die Suche im Katalog ändern oder alle reihen";
    const PREPARING = "weather and products" | "Wetter und Produkte";
    const STOP = "Stop" | "Anhalten";
    const STOP_TIP = "Stops computing; what was found stays, and can be gone on from" | "Hält die Rechnung an; Gefundenes bleibt, und es kann weitergehen";
    const AGAIN = "Rank again" | "Neu reihen";
    const AGAIN_TIP = "Room, place, weather, control, catalogue or search have changed; only products whose figures are not known yet are computed" | "Raum, Ort, Wetter, Regelung, Katalog oder Suche haben sich geändert; gerechnet werden nur Produkte, deren Kennwerte noch nicht bekannt sind";
    const CONTINUE = "Go on" | "Weiter";
    fn unfinished(left) = "{left} products are still to be computed with beams as they are" | "{left} Produkte sind noch mit Strahlen, wie sie sind, zu rechnen";
    const FIND_FIGURE = "Compute" | "Rechnen";
    const FIND_FIGURE_TIP = "The figure of an objective is not known of all products yet" | "Der Kennwert eines Ziels ist noch nicht von allen Produkten bekannt";
    fn done(done, all) = "{done} of {all} products" | "{done} von {all} Produkten";
    fn by_cells(done, all) = "{done} of {all} products by data on cells" | "{done} von {all} Produkten nach Daten auf Feldern";
    fn left(done, seconds) = "{done}, {seconds} s left" | "{done}, noch {seconds} s";

    // Table and plot.
    const TABLE = "Products" | "Produkte";
    const TABLE_TIP = "Products in rows, with bars of what they are worth" | "Produkte in Zeilen, mit Balken für ihren Wert";
    const PLOT = "Plot" | "Diagramm";
    const PLOT_TIP = "Two objectives against each other" | "Zwei Ziele gegeneinander";
    const OBJECTIVES = "Objectives" | "Ziele";
    const OBJECTIVES_TIP = "What counts, how much, and between which anchors" | "Was zählt, wie viel und zwischen welchen Ankern";
    const LIST_NAME = "Products in order; arrow keys walk, Enter takes one into the room" | "Produkte in Reihenfolge; Pfeiltasten gehen, Eingabe nimmt eines in den Raum";
    fn order_by(name) = "Order by {name}" | "Ordnen nach {name}";
    fn shown(shown, all) = "{shown} of {all} shown" | "{shown} von {all} gezeigt";
    const FILTER = "filter" | "filtern";
    const FILTER_TIP = "Words that names have to hold" | "Wörter, die Namen enthalten müssen";
    const FRONT_ONLY = "front" | "Front";
    const FRONT_TIP = "Only products that no other is better than in every objective" | "Nur Produkte, zu denen keines in jedem Ziel besser ist";
    fn excluded_too(count) = "left out ({count})" | "ausgelassen ({count})";
    const EXCLUDED_TIP = "Products that take no part too, with the reason" | "Auch Produkte, die nicht teilnehmen, mit dem Grund";
    const PLOT_NAME = "Objectives against each other" | "Ziele gegeneinander";
    const PLOT_FOOT = "Point at a product for its figures; click to read why it stands there" | "Auf ein Produkt zeigen für seine Kennwerte; anklicken, um zu lesen, warum es dort steht";
    const ACROSS = "to the right" | "nach rechts";
    const UP = "upwards" | "nach oben";
    const RANK = "Rank" | "Rang";
    const RANK_TIP_HEAD = "A range where the errors leave the order open" | "Eine Spanne, wo die Unsicherheiten die Ordnung offen lassen";
    fn rank_is(rank) = "rank {rank}" | "Rang {rank}";
    const PRODUCT = "Product" | "Produkt";
    const SCORE = "Worth" | "Wert";
    const SCORE_TIP = "Mean of what the objectives are worth, by their weights: 0 at their worst, 1 at their best; the line is its error" | "Mittel dessen, was die Ziele wert sind, nach Gewichten: 0 beim schlechtesten, 1 beim besten; der Strich ist die Unsicherheit";
    fn score(value, error) = "worth {value} ± {error}" | "Wert {value} ± {error}";
    const LESS_IS_BETTER = "less is better" | "weniger ist besser";
    const MORE_IS_BETTER = "more is better" | "mehr ist besser";
    const MARKS_TIP = "◆ no other is better in every objective · ≈ approximate · ⌂ in the room; pale: by data on cells so far" | "◆ keines in jedem Ziel besser · ≈ Näherung · ⌂ im Raum; blass: bisher nach Daten auf Feldern";
    const COARSE_TIP = "By data on cells so far, which blur the sun; beams as they are follow" | "Bisher nach Daten auf Feldern, die die Sonne verwischen; Strahlen, wie sie sind, folgen";
    fn approximate_since(reasons) = "Approximate: {reasons}" | "Näherung: {reasons}";

    // Reasons of the ranking, and what can be done next.
    const CHOOSE_ONE = "Choose a product to read why it stands where it does; double click takes it into the room" | "Ein Produkt wählen, um zu lesen, warum es dort steht; Doppelklick nimmt es in den Raum";
    const ONLY_ONE = "There is no other to set it against" | "Es gibt kein anderes, gegen das es stünde";
    const AGAINST = "against" | "gegen";
    const AGAINST_TIP = "Against which other one; Shift and a click on a row does the same" | "Gegen welches andere; Umschalt und ein Klick auf eine Zeile tut dasselbe";
    const THE_BEST = "the best" | "das beste";
    fn surely_above(score, other) = "{score} above {other}" | "{score} über {other}";
    fn surely_below(score, other) = "{score} below {other}" | "{score} unter {other}";
    fn open_above(score, other) = "{score} above {other}, which the errors do not tell apart" | "{score} über {other}, was die Unsicherheiten nicht trennen";
    fn open_below(score, other) = "{score} below {other}, which the errors do not tell apart" | "{score} unter {other}, was die Unsicherheiten nicht trennen";
    fn by_objective(score, name, own, other) = "{score} by {name}: {own} against {other}" | "{score} durch {name}: {own} gegen {other}";
    fn part_is(value, when) = "{value} in {when}" | "{value} bei {when}";
    const INTO_ROOM = "Into the room" | "In den Raum";
    const INTO_ROOM_TIP = "This product takes the place of the one in the room; undo takes it back" | "Dieses Produkt tritt an die Stelle dessen im Raum; Rückgängig nimmt es zurück";
    const ADD_TO_COMPARISON = "Into the comparison" | "In den Vergleich";
    const ADD_TO_COMPARISON_TIP = "This product into the comparison's tray" | "Dieses Produkt in die Ablage des Vergleichs";
    fn excluded_because(reason) = "Takes no part: {reason}" | "Nimmt nicht teil: {reason}";

    // Objectives.
    const WEIGHT_TIP = "How much it counts, relative to the others" | "Wie viel es zählt, im Verhältnis zu den anderen";
    fn weight_of(name) = "Weight of {name}" | "Gewicht von {name}";
    const WORST = "0 at" | "0 bei";
    const WORST_TIP = "Where it is worth 0; what is worse is worth no less" | "Wo es 0 wert ist; Schlechteres ist nicht weniger wert";
    fn worst_of(name) = "Worst of {name}" | "Schlechtestes von {name}";
    const BEST = "1 at" | "1 bei";
    const BEST_TIP = "Where it is worth 1; what is better is worth no more" | "Wo es 1 wert ist; Besseres ist nicht mehr wert";
    fn best_of(name) = "Best of {name}" | "Bestes von {name}";
    fn leave_out(name) = "Leave out {name}" | "{name} weglassen";
    const LEAVE_OUT_TIP = "No longer an objective; its figures stay known" | "Kein Ziel mehr; seine Kennwerte bleiben bekannt";
    const ADD_OBJECTIVE = "Add an objective" | "Ein Ziel hinzufügen";
    const ADD_OBJECTIVE_TIP = "Figures of the year that may count" | "Kennwerte des Jahrs, die zählen können";
    const FIGURE_KNOWN = "Known of all products: orders at once" | "Von allen Produkten bekannt: ordnet sofort";
    const FIGURE_TO_COMPUTE = "To be computed for all products" | "Für alle Produkte noch zu rechnen";
    fn to_compute(name) = "{name} (to be computed)" | "{name} (zu rechnen)";
    const IN_SEARCH = "only what the search finds" | "nur was die Suche findet";
    fn in_search(count) = "only what the search finds ({count})" | "nur was die Suche findet ({count})";
    const IN_SEARCH_TIP = "Products of the catalogue's list as its words and chips have it now" | "Produkte der Katalogliste, wie deren Wörter und Filter sie gerade haben";
    const APERTURE = "Aperture that is ranked" | "Öffnung, die gereiht wird";
    const APERTURE_TIP = "Which aperture products go into" | "In welche Öffnung die Produkte kommen";
    const ALL_APERTURES = "all of the catalogue" | "alle aus dem Katalog";
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
