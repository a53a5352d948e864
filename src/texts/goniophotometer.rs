//! Texts of the goniophotometer's sheet.

texts! {
    const OFFER = "Compute gives transmission and reflection from both sides, with balance, reciprocity and error; then it can be added to the catalogue." | "„Rechnen“ ergibt Transmission und Reflexion von beiden Seiten, mit Bilanz, Reziprozität und Unsicherheit; danach kann das System in den Katalog.";
    const OPEN = "Open…" | "Öffnen…";
    const OPEN_TIP = "Read a .system.toml (Ctrl+O), or drop it on the window" | "Eine .system.toml lesen (Strg+O), oder auf das Fenster ziehen";
    const OR_START_FROM = "or start from" | "oder beginnen mit";
    const GEOMETRY = "Geometry and material" | "Geometrie und Material";
    fn and_states(count) = ", {count} states" | ", {count} Stellungen";
    const UNITS = "Lengths in metres, angles in degrees." | "Längen in Metern, Winkel in Grad.";
    const SECTION_ABOVE = "Section from above" | "Schnitt von oben";
    const SECTION = "Section" | "Schnitt";
    const PREVIOUS_STATE = "Previous state" | "Vorige Stellung";
    const NEXT_STATE = "Next state" | "Nächste Stellung";
    const INCIDENT = "Incident" | "Einfall";
    const EMERGENT = "Emergent" | "Austritt";
    const ERROR_AT_MOST = "Error of τ, ρ at most" | "Unsicherheit von τ, ρ höchstens";
    const ERROR_TIP = "Absolute, of every incidence; the effort follows it" | "Absolut, für jeden Einfall; der Aufwand folgt daraus";
    const STOP = "Stop" | "Anhalten";
    const STOP_TIP = "Finished states are kept; Compute goes on after them" | "Fertige Stellungen bleiben; „Rechnen“ geht danach weiter";
    fn state_of(number, count) = "state {number} of {count}" | "Stellung {number} von {count}";
    const COMPUTE = "Compute" | "Rechnen";
    const DESCRIBE_FIRST = "Describe a system first" | "Zuerst ein System beschreiben";
    const COMPUTE_TIP = "All states, both sides, transmission and reflection" | "Alle Stellungen, beide Seiten, Transmission und Reflexion";
    fn stopped_after(count) = "stopped after {count} states; goes on after them" | "nach {count} Stellungen angehalten; geht danach weiter";
    fn changed_since(name) = "\"{name}\" as it was computed; the text or the cells have changed since." | "„{name}“, wie gerechnet; Text oder Zellen haben sich seitdem geändert.";
    const ADD = "Add to catalogue" | "In den Katalog";
    const WHEN_FINISHED = "When all states are finished" | "Wenn alle Stellungen fertig sind";
    const ADD_TIP = "All states as one product; Ctrl+Z takes it out again" | "Alle Stellungen als ein Produkt; Strg+Z nimmt es wieder heraus";
    const EXPORT = "Export…" | "Ausgeben…";
    const STATE = "State" | "Stellung";
    const STATE_TIP = "Key of the state" | "Schlüssel der Stellung";
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_NORMAL_TIP = "Transmittance at normal incidence, all light that passes" | "Transmissionsgrad bei senkrechtem Einfall, alles durchgelassene Licht";
    const BALANCE = "τ+ρ+α−1" | "τ+ρ+α−1";
    const BALANCE_TIP = "Energy balance, at the worst incidence" | "Energiebilanz, beim ungünstigsten Einfall";
    const RECIPROCITY = "Reciprocity" | "Reziprozität";
    const RECIPROCITY_TIP = "Flux that reciprocity would place elsewhere, a share of all" | "Lichtstrom, der nach der Reziprozität anderswo wäre, als Anteil am ganzen";
    const ERROR = "Error" | "Unsicherheit";
    const ERRORS_TIP = "Estimated error of τ and ρ, at the worst incidence" | "Geschätzte Unsicherheit von τ und ρ, beim ungünstigsten Einfall";
    const TIME = "Time" | "Zeit";
    const TIME_TIP = "Wall-clock time" | "Verstrichene Zeit";
    const DESCRIBE_FIRST_HOW = "Describe a system first: an example, a file, or a text" | "Zuerst ein System beschreiben: ein Beispiel, eine Datei oder ein Text";
    const COMPUTE_FIRST = "Compute the system first" | "Zuerst das System rechnen";

    const KLEMS = "Klems 145" | "Klems 145";
    const TREGENZA = "Tregenza 145" | "Tregenza 145";
    fn cells(degrees) = "{degrees}° cells" | "Zellen von {degrees}°";

    const VENETIAN = "Venetian" | "Jalousie";
    const LOUVRES = "Louvres upright" | "Senkrechtlamellen";
    const LASER_CUT = "Laser-cut panel" | "Lasergeschnittene Platte";
    const PRISMATIC = "Prismatic" | "Prismen";
    const REDIRECTING = "Redirecting glass" | "Lenkglas";
    const PANES = "Panes" | "Scheiben";
    const COATED = "Coated pane" | "Beschichtete Scheibe";
    const DIFFUSER = "Diffuser" | "Streuscheibe";
    const WOVEN = "Woven" | "Gewebe";
    const PERFORATED = "Perforated" | "Lochblech";
    const EXPANDED = "Expanded metal" | "Streckmetall";
    const STACK = "Stack" | "Schichtung";
}
