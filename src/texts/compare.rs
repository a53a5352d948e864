//! Texts of comparing products, states, moments and rooms.

texts! {
    // The comparison.
    const COMPARE = "Compare" | "Vergleichen";
    const COMPARE_TIP = "All of the tray in the tiles' place, or back to the tiles (Shift+X)" | "Die ganze Vergleichsliste anstelle der Kacheln, oder zurück zu den Kacheln (Umschalt+X)";
    const SWAP = "Swap" | "Tauschen";
    const SWAP_TIP = "The other one in all tiles, and back (X)" | "Den anderen in allen Kacheln zeigen, und zurück (X)";
    fn comparing(count) = "Comparing {count}" | "Vergleich: {count}";
    const SCENES_OWN = "As in the scene" | "Wie in der Szene";
    fn shown(what) = "Shown: {what}. X shows the next of the tray in all tiles, and goes back" | "Zu sehen: {what}. X zeigt den nächsten der Vergleichsliste in allen Kacheln, und geht zurück";
    const NAME_IN_COMPARISON = "Name in the tray" | "Name in der Vergleichsliste";
    fn candidate(name) = "Candidate {name}" | "Kandidat {name}";
    const SHOW_IN_TILES = "Show in the tiles" | "In den Kacheln zeigen";
    const SHOW_IN_TILES_TIP = "X goes back to the scene's own" | "X geht zurück zur Szene selbst";
    const TAKE = "Make it the scene" | "Zur Szene machen";
    const TAKE_TIP = "Product, state and what else it has of its own; undo goes back" | "Produkt, Stellung und was er sonst Eigenes hat; Rückgängig geht zurück";
    const BASE = "Differences from it" | "Differenzen zu diesem";
    const BASE_TIP = "The others less this one" | "Die anderen minus diesen";
    const RENAME = "Rename…" | "Umbenennen…";
    const RENAME_TIP = "Another name in the tray" | "Ein anderer Name in der Vergleichsliste";
    const MOVE_LEFT = "Move left" | "Nach links";
    const MOVE_LEFT_TIP = "One place earlier" | "Einen Platz nach vorn";
    const MOVE_RIGHT = "Move right" | "Nach rechts";
    const MOVE_RIGHT_TIP = "One place later" | "Einen Platz nach hinten";
    const REMOVE = "Remove" | "Entfernen";
    const REMOVE_TIP = "Take it out of the tray" | "Aus der Vergleichsliste nehmen";

    // Ways of comparing.
    const BESIDE = "Side by side" | "Nebeneinander";
    const BESIDE_TIP = "The same tile for each, all on one scale" | "Für jeden dieselbe Kachel, alle mit einer Skala";
    const DIFFERENCE = "Difference" | "Differenz";
    const DIFFERENCE_TIP = "Each less the chosen base, with sign; zero is in the middle of the scale" | "Jeder minus die gewählte Basis, mit Vorzeichen; null ist in der Mitte der Skala";
    const CURVES = "Curves" | "Kurven";
    const CURVES_TIP = "All in one plot: luminous intensity, depth of the room, transmittance, control" | "Alle in einem Diagramm: Lichtstärke, Raumtiefe, Transmissionsgrad, Regelung";
    const FIGURES = "Figures" | "Kennzahlen";
    const FIGURES_TIP = "One table with errors; the better one is marked where the difference is larger" | "Eine Tabelle mit Unsicherheiten; der bessere ist markiert, wo der Unterschied größer ist";
    const TILE_TIP = "Which tile is compared" | "Welche Kachel verglichen wird";
    const TILE = "Compared tile" | "Verglichene Kachel";
    const LESS = "less" | "minus";
    fn less_base(base) = "less {base}" | "minus {base}";
    const BASE_CHOICE_TIP = "From which one the differences are taken" | "Wovon die Differenzen genommen werden";
    const BASE_CHOICE = "Base of differences" | "Basis der Differenzen";
    const CONTINUE = "Go on" | "Weiter";
    const CONTINUE_TIP = "Compute what is missing" | "Berechnen, was fehlt";
    const CLOSE = "Close" | "Schließen";
    const CLOSE_TIP = "Back to the tiles" | "Zurück zu den Kacheln";
    const COMMON_SCALE = "Scale of all tiles" | "Skala aller Kacheln";
    fn common_scale_is(low, high, unit) = "{low} to {high} {unit}" | "{low} bis {high} {unit}";
    fn one_scale(what) = "One scale for all: {what}" | "Eine Skala für alle: {what}";
    const LOG = "log" | "log";
    const LOG_TIP = "Logarithmic in all tiles" | "Logarithmisch in allen Kacheln";

    // Texts in place of a picture.
    const COMPUTING = "Computing…" | "Wird berechnet…";
    const NO_CURVES = "None of these follows a rule that has a curve." | "Keiner von diesen folgt einer Regel, die eine Kurve hat.";
    const CURVES_OF = "Curves are drawn of LID, room, transmittance and control." | "Kurven gibt es von LVK, Raum, Transmissionsgrad und Regelung.";
    fn curves_name(tile) = "Curves of {tile}" | "Kurven: {tile}";
    const DIFFERENCES_OF = "Differences are drawn of BTDF, transmittance and room. Curves and figures compare the others." | "Differenzen gibt es von BTDF, Transmissionsgrad und Raum. Kurven und Kennzahlen vergleichen die anderen.";
    const TAKES_TWO = "A difference takes two: add another product, state or moment (C)." | "Zu einer Differenz gehören zwei: noch ein Produkt, eine Stellung oder einen Zeitpunkt hinzufügen (C).";
    const OTHER_SENSORS = "The sensors are not the same: nothing can be taken from the other." | "Die Messpunkte sind nicht dieselben: keine Differenz.";
    const NO_TRANSMISSION = "No transmission in the data." | "Keine Transmission in den Daten.";
    const NOTHING_MOVES = "No product of the catalogue: nothing moves." | "Kein Produkt des Katalogs: nichts bewegt sich.";
    const NOT_THERE = "what it is made of is not there" | "woraus es gemacht wird, ist nicht da";

    // The table of figures.
    const FIGURE = "Figure" | "Kennzahl";
    const BETTER = "Better" | "Besser";
    const BETTER_TIP = "Where the difference is larger than the errors together" | "Wo der Unterschied größer ist als die Unsicherheiten zusammen";
    fn better(sense) = "Better: {sense}" | "Besser: {sense}";
    const AND = " and " | " und ";
    const ERRORS_NOTE = "Errors are those of computation and data that are stated; measured data state none." | "Unsicherheiten sind die angegebenen von Rechnung und Daten; gemessene Daten geben keine an.";
    const COPY_CSV = "Copy as CSV" | "Als CSV kopieren";
    const COPY_CSV_TIP = "The table with all digits into the clipboard" | "Die Tabelle mit allen Ziffern in die Zwischenablage";
    const COPIED = "Figures copied as CSV" | "Kennzahlen als CSV kopiert";
    const MORE = "more is better" | "mehr ist besser";
    const FEWER = "less is better" | "weniger ist besser";
    const AIM = "a matter of aim" | "Frage des Ziels";
    const WITHIN = "within the errors" | "innerhalb der Unsicherheit";
    const UNSTATED = "error not stated" | "Unsicherheit nicht angegeben";

    // Figures.
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_NORMAL_TIP = "Visible transmittance of light from outside at normal incidence; light or shade may be wanted" | "Lichttransmissionsgrad von außen bei senkrechtem Einfall; Licht oder Schatten kann gewünscht sein";
    const TAU_HEMISPHERICAL = "τ hemispherical" | "τ hemisphärisch";
    const TAU_HEMISPHERICAL_TIP = "The same under uniform luminance; light or shade may be wanted" | "Derselbe bei gleichförmiger Leuchtdichte; Licht oder Schatten kann gewünscht sein";
    const TO_CEILING = "Light to the ceiling" | "Licht zur Decke";
    const TO_CEILING_TIP = "Share of the light transmitted from above the horizon that leaves upwards: what reaches deep without glare" | "Anteil des von über dem Horizont durchgelassenen Lichts, der nach oben geht: was ohne Blendung in die Tiefe reicht";
    const SUN_BLOCKED = "Sun blocked" | "Sonne abgehalten";
    const SUN_BLOCKED_TIP = "1 − τ for a sun straight before the façade, 45° high: less heat and glare" | "1 − τ für eine Sonne gerade vor der Fassade, 45° hoch: weniger Wärme und Blendung";
    const VIEW = "View" | "Durchsicht";
    const VIEW_TIP = "Share of light at normal incidence that goes straight on" | "Anteil des senkrecht einfallenden Lichts, der gerade hindurchgeht";
    const FLUX = "Luminous flux" | "Lichtstrom";
    const FLUX_TIP = "All light that enters by the first aperture, the sun's beam included" | "Alles Licht durch die erste Öffnung, der Sonnenstrahl eingeschlossen";
    const PEAK = "Scattered peak of the LID" | "Größte gestreute Lichtstärke";
    const PEAK_TIP = "Largest scattered intensity as a luminaire file holds it: brightness to the ceiling is wanted, to the eyes it is not" | "Größte gestreute Lichtstärke, wie eine Leuchtendatei sie enthält: zur Decke gewünscht, ins Auge nicht";
    const MEAN = "Mean illuminance" | "Mittlere Beleuchtungsstärke";
    const MEAN_TIP = "Mean over the sensors; light or shade may be wanted" | "Mittel über die Messpunkte; Licht oder Schatten kann gewünscht sein";
    const LEAST = "Darkest sensor" | "Dunkelster Messpunkt";
    const LEAST_TIP = "Least illuminance of any sensor: where daylight is short" | "Kleinste Beleuchtungsstärke aller Messpunkte: wo Tageslicht fehlt";
    const GREATEST = "Brightest sensor" | "Hellster Messpunkt";
    const GREATEST_TIP = "Greatest illuminance of any sensor; much more than elsewhere may dazzle" | "Größte Beleuchtungsstärke aller Messpunkte; viel mehr als anderswo kann blenden";
    const UNIFORMITY = "Uniformity" | "Gleichmäßigkeit";
    const UNIFORMITY_TIP = "Least over mean illuminance" | "Kleinste zu mittlerer Beleuchtungsstärke";
    const SHARE_300 = "Sensors with 300 lx" | "Messpunkte mit 300 lx";
    const SHARE_300_TIP = "Share of the sensors with at least 300 lx, the target of EN 17037" | "Anteil der Messpunkte mit mindestens 300 lx, dem Ziel der EN 17037";

    // Axes of the curves.
    fn gamma_in(planes) = "γ in {planes}" | "γ in {planes}";
    const FROM_FACADE = "distance from the façade" | "Abstand von der Fassade";
    const E_MIDDLE_ROW = "E, middle row" | "E, mittlere Reihe";
    const PROFILE_ANGLE = "profile angle" | "Profilwinkel";
    const STATE = "state" | "Stellung";

    // Messages.
    const COMPARISON_EMPTY = "Nothing to compare yet: C adds what is shown, or use the ⊕ of a row in the catalogue" | "Noch nichts zu vergleichen: C fügt hinzu, was zu sehen ist, oder das ⊕ einer Zeile im Katalog";
    fn comparison_full(most) = "The tray holds {most}: take one out first" | "Die Vergleichsliste fasst {most}: erst einen herausnehmen";
    const NOTHING_SHOWN = "Nothing is shown yet that could be compared" | "Noch ist nichts zu sehen, was verglichen werden könnte";
    const ALREADY_IN_COMPARISON = "In the tray already. Shift+C adds it with this moment, to be compared with another one" | "Schon in der Vergleichsliste. Umschalt+C fügt es mit diesem Zeitpunkt hinzu, zum Vergleich mit einem anderen";
    const NOT_LISTED = "The product is not in the list: search for it, then add it" | "Das Produkt ist nicht in der Liste: erst suchen, dann hinzufügen";
    const NOTHING_TO_SWAP = "Nothing to swap with: add what is shown (C), choose another product or state, then X" | "Nichts zum Tauschen: hinzufügen, was zu sehen ist (C), ein anderes Produkt oder eine andere Stellung wählen, dann X";
    const NO_PRODUCT_CHOSEN = "No product is chosen" | "Kein Produkt gewählt";

    // In a report.
    const CHAPTER = "Comparison" | "Vergleich";
    fn chapter_difference(tile, base) = "Difference from {base}: {tile}" | "Differenz zu {base}: {tile}";
    fn chapter_beside(tile) = "Side by side on one scale: {tile}" | "Nebeneinander mit einer Skala: {tile}";
    const MARK_NOTE = "▲ marks what is better by more than the errors together; errors are those of computation and data that are stated, and measured data state none." | "▲ zeigt, was um mehr als die Unsicherheiten zusammen besser ist; Unsicherheiten sind die angegebenen von Rechnung und Daten, gemessene Daten geben keine an.";
    const SIGN_NOTE = "Red is more than the base, blue is less, white the same; all pictures have the same scale." | "Rot ist mehr als die Basis, Blau weniger, Weiß dasselbe; alle Bilder haben dieselbe Skala.";
    fn mean_difference(name, mean, distinct, all) = "mean {name} {mean}, more than the errors at {distinct} of {all} sensors" | "{name} im Mittel {mean}, mehr als die Unsicherheit an {distinct} von {all} Messpunkten";
    fn ends(name, low, high) = "{name} from {low} to {high}" | "{name} von {low} bis {high}";
    const NO_DIFFERENCE = "the sensors or data are not the same kind: no difference" | "Messpunkte oder Daten sind nicht von gleicher Art: keine Differenz";
    fn not_drawn(name, why) = "{name}: {why}" | "{name}: {why}";
    const ONE_MORE = "One candidate alone has nothing to be compared with." | "Ein Kandidat allein hat nichts zum Vergleichen.";
}
