//! Texts of comparing products, states, moments and rooms.

texts! {
    // The comparison.
    const COMPARE = "Compare" | "Vergleichen";
    const COMPARE_TIP = "Shows the comparison instead of the tiles, or the tiles again (Shift+X)" | "Zeigt den Vergleich anstelle der Kacheln, oder wieder die Kacheln (Umschalt+X)";
    const SWAP = "Swap" | "Tauschen";
    const SWAP_TIP = "Shows the other candidate in all tiles, and back (X)" | "Zeigt den anderen Kandidaten in allen Kacheln, und zurück (X)";
    fn comparing(count) = "Comparing {count}" | "Vergleich: {count}";
    const SCENES_OWN = "As in the scene" | "Wie in der Szene";
    fn shown(what) = "Shown: {what}. X shows the next candidate of the comparison in all tiles, and back" | "Gezeigt: {what}. X zeigt den nächsten Kandidaten des Vergleichs in allen Kacheln, und zurück";
    const NAME_IN_COMPARISON = "Name in the comparison" | "Name im Vergleich";
    fn candidate(name) = "Candidate {name}" | "Kandidat {name}";
    const SHOW_IN_TILES = "Show in the tiles" | "In den Kacheln zeigen";
    const SHOW_IN_TILES_TIP = "Shows this candidate in all tiles; X returns to the scene" | "Zeigt diesen Kandidaten in allen Kacheln; X führt zurück zur Szene";
    const TAKE = "Use as scene" | "Als Szene übernehmen";
    const TAKE_TIP = "Takes product, state and all else that the candidate sets into the scene; undo restores it" | "Übernimmt Produkt, Stellung und alles, was der Kandidat festlegt, in die Szene; Rückgängig stellt sie wieder her";
    const BASE = "Use as reference" | "Als Bezug verwenden";
    const BASE_TIP = "Takes the differences of the other candidates from this one" | "Bildet die Differenzen der anderen Kandidaten zu diesem";
    const RENAME = "Rename…" | "Umbenennen…";
    const RENAME_TIP = "Changes the name in the comparison" | "Ändert den Namen im Vergleich";
    const MOVE_LEFT = "Move left" | "Nach links";
    const MOVE_LEFT_TIP = "Moves the candidate one place to the left" | "Schiebt den Kandidaten um einen Platz nach links";
    const MOVE_RIGHT = "Move right" | "Nach rechts";
    const MOVE_RIGHT_TIP = "Moves the candidate one place to the right" | "Schiebt den Kandidaten um einen Platz nach rechts";
    const REMOVE = "Remove" | "Entfernen";
    const REMOVE_TIP = "Removes the candidate from the comparison" | "Entfernt den Kandidaten aus dem Vergleich";

    // Ways of comparing.
    const BESIDE = "Side by side" | "Nebeneinander";
    const BESIDE_TIP = "Shows the same tile for each candidate, all on one scale" | "Zeigt für jeden Kandidaten dieselbe Kachel, alle mit einer Skala";
    const DIFFERENCE = "Difference" | "Differenz";
    const DIFFERENCE_TIP = "Shows each candidate minus the reference, with sign; zero is in the middle of the scale" | "Zeigt jeden Kandidaten minus den Bezug, mit Vorzeichen; null ist in der Mitte der Skala";
    const CURVES = "Curves" | "Kurven";
    const CURVES_TIP = "Shows all candidates in one plot: luminous intensity, section of the room, transmittance, control" | "Zeigt alle Kandidaten in einem Diagramm: Lichtstärke, Raumtiefe, Transmissionsgrad, Steuerung";
    const FIGURES = "Figures" | "Kennwerte";
    const FIGURES_TIP = "Shows one table with uncertainties; the better value is marked where the difference is larger" | "Zeigt eine Tabelle mit Unsicherheiten; der bessere Wert ist markiert, wo der Unterschied größer ist";
    const TILE_TIP = "Selects the tile to compare" | "Wählt die zu vergleichende Kachel";
    const TILE = "Compared tile" | "Verglichene Kachel";
    const LESS = "minus" | "minus";
    fn less_base(base) = "minus {base}" | "minus {base}";
    const BASE_CHOICE_TIP = "Selects the candidate that differences are taken from" | "Wählt den Kandidaten, zu dem Differenzen gebildet werden";
    const BASE_CHOICE = "Reference of differences" | "Bezug der Differenzen";
    const CONTINUE = "Continue" | "Fortsetzen";
    const CONTINUE_TIP = "Computes what is missing" | "Berechnet, was fehlt";
    const CLOSE = "Close" | "Schließen";
    const CLOSE_TIP = "Returns to the tiles" | "Führt zurück zu den Kacheln";
    const COMMON_SCALE = "Scale of all tiles" | "Skala aller Kacheln";
    fn common_scale_is(low, high, unit) = "{low} to {high} {unit}" | "{low} bis {high} {unit}";
    fn one_scale(what) = "One scale for all: {what}" | "Eine Skala für alle: {what}";
    const LOG = "log" | "log";
    const LOG_TIP = "Makes the scale of all tiles logarithmic" | "Macht die Skala aller Kacheln logarithmisch";

    // Texts in place of a picture.
    const COMPUTING = "Computing…" | "Wird berechnet…";
    const NO_CURVES = "None of the candidates has a control curve." | "Keiner der Kandidaten hat eine Steuerkurve.";
    const CURVES_OF = "Curves are available for LID, room, transmittance and control." | "Kurven gibt es von LVK, Raum, Transmissionsgrad und Steuerung.";
    fn curves_name(tile) = "Curves of {tile}" | "Kurven: {tile}";
    const DIFFERENCES_OF = "Differences are available for BTDF, transmittance and room; for other tiles see curves and figures." | "Differenzen gibt es von BTDF, Transmissionsgrad und Raum; für andere Kacheln siehe Kurven und Kennwerte.";
    const TAKES_TWO = "A difference needs two candidates: add another product, state or date and time (C)." | "Eine Differenz braucht zwei Kandidaten: ein weiteres Produkt, eine Stellung oder einen Zeitpunkt hinzufügen (C).";
    const OTHER_SENSORS = "No difference: the calculation points are not the same." | "Keine Differenz: die Berechnungspunkte sind nicht dieselben.";
    const NO_TRANSMISSION = "The data contain no transmission." | "Die Daten enthalten keine Transmission.";
    const NOTHING_MOVES = "No catalogue product: no control." | "Kein Produkt aus dem Katalog: keine Steuerung.";
    const NOT_THERE = "its data are missing" | "die Daten dafür fehlen";

    // The table of figures.
    const FIGURE = "Figure" | "Kennwert";
    const BETTER = "Better" | "Besser";
    const BETTER_TIP = "Better where the difference is larger than both uncertainties together" | "Besser, wo der Unterschied größer ist als beide Unsicherheiten zusammen";
    fn better(sense) = "Better: {sense}" | "Besser: {sense}";
    const AND = " and " | " und ";
    const ERRORS_NOTE = "Uncertainties are those stated by computation and data; measured data state none." | "Unsicherheiten sind die angegebenen von Rechnung und Daten; gemessene Daten geben keine an.";
    const COPY_CSV = "Copy as CSV" | "Als CSV kopieren";
    const COPY_CSV_TIP = "Copies the table with all digits to the clipboard" | "Kopiert die Tabelle mit allen Ziffern in die Zwischenablage";
    const COPIED = "Figures copied as CSV" | "Kennwerte als CSV kopiert";
    const MORE = "more is better" | "mehr ist besser";
    const FEWER = "less is better" | "weniger ist besser";
    const AIM = "depends on the aim" | "abhängig vom Ziel";
    const WITHIN = "within the uncertainty" | "innerhalb der Unsicherheit";
    const UNSTATED = "uncertainty not stated" | "Unsicherheit nicht angegeben";

    // Figures.
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_NORMAL_TIP = "Visible transmittance for light from outside at normal incidence; more or less may be wanted" | "Lichttransmissionsgrad von außen bei senkrechtem Einfall; mehr oder weniger kann gewünscht sein";
    const TAU_HEMISPHERICAL = "τ hemispherical" | "τ hemisphärisch";
    const TAU_HEMISPHERICAL_TIP = "Visible transmittance for light from a uniform hemisphere outside; more or less may be wanted" | "Lichttransmissionsgrad für Licht aus einer gleichförmigen Hemisphäre außen; mehr oder weniger kann gewünscht sein";
    const TO_CEILING = "Light to the ceiling" | "Licht zur Decke";
    const TO_CEILING_TIP = "Share of the light transmitted from above the horizon that leaves upwards and lights the depth of the room without glare" | "Anteil des von über dem Horizont durchgelassenen Lichts, der nach oben geht und die Raumtiefe ohne Blendung beleuchtet";
    const SUN_BLOCKED = "Sun blocked at 45°" | "Sonne abgehalten bei 45°";
    const SUN_BLOCKED_TIP = "1 − τ for direct sun at 45° altitude, perpendicular to the façade in plan" | "1 − τ für direktes Sonnenlicht bei 45° Sonnenhöhe, im Grundriss senkrecht zur Fassade";
    const VIEW = "View" | "Durchsicht";
    const VIEW_TIP = "Normal–normal transmittance τ_n-n: unscattered part at normal incidence (EN 14501)" | "Transmissionsgrad normal-normal τ_n-n: ungestreuter Teil bei senkrechtem Einfall (EN 14501)";
    const FLUX = "Luminous flux" | "Lichtstrom";
    const FLUX_TIP = "All light that enters through the first aperture, direct sunlight included" | "Alles Licht durch die erste Öffnung, direktes Sonnenlicht eingeschlossen";
    const PEAK = "Peak scattered intensity" | "Größte gestreute Lichtstärke";
    const PEAK_TIP = "Largest scattered luminous intensity, as in a luminaire file; wanted towards the ceiling, not towards observers" | "Größte gestreute Lichtstärke, wie in einer Leuchtendatei; zur Decke gewünscht, zu Beobachtern nicht";
    const MEAN = "Mean illuminance" | "Mittlere Beleuchtungsstärke";
    const MEAN_TIP = "Mean illuminance of the calculation points; more or less may be wanted" | "Mittlere Beleuchtungsstärke der Berechnungspunkte; mehr oder weniger kann gewünscht sein";
    const LEAST = "Minimum illuminance" | "Kleinste Beleuchtungsstärke";
    const LEAST_TIP = "Smallest illuminance of the calculation points" | "Kleinste Beleuchtungsstärke der Berechnungspunkte";
    const GREATEST = "Maximum illuminance" | "Größte Beleuchtungsstärke";
    const GREATEST_TIP = "Largest illuminance of the calculation points; far above the others it may cause glare" | "Größte Beleuchtungsstärke der Berechnungspunkte; weit über den anderen kann sie blenden";
    const UNIFORMITY = "Uniformity U_o" | "Gleichmäßigkeit U_o";
    const UNIFORMITY_TIP = "Minimum to mean illuminance, E_min/E_mean (EN 12464)" | "Kleinste zu mittlerer Beleuchtungsstärke, E_min/E_m (EN 12464)";
    const SHARE_300 = "Points with ≥ 300 lx" | "Punkte mit ≥ 300 lx";
    const SHARE_300_TIP = "Share of the calculation points with at least 300 lx, the minimum level of EN 17037" | "Anteil der Berechnungspunkte mit mindestens 300 lx, der Stufe gering der EN 17037";

    // Axes of the curves.
    fn gamma_in(planes) = "γ in {planes}" | "γ in {planes}";
    const FROM_FACADE = "distance from the façade" | "Abstand von der Fassade";
    const E_MIDDLE_ROW = "E, middle row" | "E, mittlere Reihe";
    const PROFILE_ANGLE = "profile angle" | "Profilwinkel";
    const STATE = "state" | "Stellung";

    // Messages.
    const COMPARISON_EMPTY = "Nothing to compare yet: add the current product with C, or with ⊕ in its row of the catalogue" | "Noch nichts zu vergleichen: das gezeigte Produkt mit C hinzufügen, oder mit ⊕ in seiner Zeile des Katalogs";
    fn comparison_full(most) = "The comparison holds at most {most} candidates: remove one first" | "Der Vergleich fasst höchstens {most} Kandidaten: erst einen entfernen";
    const NOTHING_SHOWN = "Nothing is shown yet that could be compared" | "Noch wird nichts gezeigt, was sich vergleichen ließe";
    const ALREADY_IN_COMPARISON = "Already in the comparison. Shift+C adds it with this date and time, to compare it with another" | "Schon im Vergleich. Umschalt+C fügt es mit diesem Zeitpunkt hinzu, zum Vergleich mit einem anderen";
    const NOT_LISTED = "The product is not in the list: search for it, then add it" | "Das Produkt ist nicht in der Liste: erst suchen, dann hinzufügen";
    const NOTHING_TO_SWAP = "Nothing to swap with: add the current product (C), select another product or state, then press X" | "Nichts zum Tauschen: das gezeigte Produkt hinzufügen (C), ein anderes Produkt oder eine andere Stellung wählen, dann X";

    // In a report.
    const CHAPTER = "Comparison" | "Vergleich";
    fn chapter_difference(tile, base) = "Difference from {base}: {tile}" | "Differenz zu {base}: {tile}";
    fn chapter_beside(tile) = "Side by side on one scale: {tile}" | "Nebeneinander mit einer Skala: {tile}";
    const MARK_NOTE = "▲ marks values that are better by more than both uncertainties together; uncertainties are those stated by computation and data, and measured data state none." | "▲ zeigt Werte, die um mehr als beide Unsicherheiten zusammen besser sind; Unsicherheiten sind die angegebenen von Rechnung und Daten, gemessene Daten geben keine an.";
    const SIGN_NOTE = "Red is more than the reference, blue is less, white the same; all pictures have the same scale." | "Rot ist mehr als der Bezug, Blau weniger, Weiß dasselbe; alle Bilder haben dieselbe Skala.";
    fn mean_difference(name, mean, distinct, all) = "mean {name} {mean}, above the uncertainty at {distinct} of {all} points" | "{name} im Mittel {mean}, mehr als die Unsicherheit an {distinct} von {all} Punkten";
    fn ends(name, low, high) = "{name} from {low} to {high}" | "{name} von {low} bis {high}";
    const NO_DIFFERENCE = "no difference: the calculation points or data do not correspond" | "keine Differenz: Berechnungspunkte oder Daten entsprechen einander nicht";
    fn not_drawn(name, why) = "{name}: {why}" | "{name}: {why}";
    const ONE_MORE = "Nothing to compare with: there is one candidate." | "Nichts zu vergleichen: es gibt nur einen Kandidaten.";
}
