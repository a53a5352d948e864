//! Texts of the goniophotometer's sheet.

texts! {
    const OFFER = "Compute gives transmission and reflection of both sides, with energy balance, reciprocity and uncertainty; then the system can be added to the catalogue." | "„Berechnen“ ergibt Transmission und Reflexion beider Seiten, mit Energiebilanz, Reziprozität und Unsicherheit; danach lässt sich das System zum Katalog hinzufügen.";
    const OPEN = "Open…" | "Öffnen…";
    const OPEN_TIP = "Reads a .system.toml file (Ctrl+O); it can also be dropped on the window" | "Liest eine .system.toml (Strg+O); sie lässt sich auch auf das Fenster ziehen";
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
    const ERROR_AT_MOST = "Uncertainty of τ, ρ at most" | "Unsicherheit von τ, ρ höchstens";
    const ERROR_TIP = "Absolute uncertainty for every incident direction; sets the effort" | "Absolute Unsicherheit für jede Einfallsrichtung; bestimmt den Aufwand";
    const STOP = "Stop" | "Anhalten";
    const STOP_TIP = "Stops and keeps finished states, so that Compute can resume" | "Hält an und behält fertige Stellungen, sodass „Berechnen“ fortsetzen kann";
    fn state_of(number, count) = "state {number} of {count}" | "Stellung {number} von {count}";
    const COMPUTE = "Compute" | "Berechnen";
    const DESCRIBE_FIRST = "Describe a system first" | "Zuerst ein System beschreiben";
    const COMPUTE_TIP = "Computes transmission and reflection of all states from both sides" | "Berechnet Transmission und Reflexion aller Stellungen von beiden Seiten";
    fn stopped_after(count) = "stopped after {count} states; Compute resumes" | "nach {count} Stellungen angehalten; „Berechnen“ setzt fort";
    fn changed_since(name) = "\"{name}\" as computed; description or basis have changed since." | "„{name}“, wie berechnet; Beschreibung oder Basis haben sich seitdem geändert.";
    const ADD = "Add to catalogue" | "Zum Katalog";
    const WHEN_FINISHED = "When all states are finished" | "Wenn alle Stellungen fertig sind";
    const ADD_TIP = "Stores all states as one product; Ctrl+Z removes it" | "Speichert alle Stellungen als ein Produkt; Strg+Z entfernt es";
    const EXPORT = "Export…" | "Exportieren…";
    const STATE = "State" | "Stellung";
    const STATE_TIP = "Key of the state" | "Schlüssel der Stellung";
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_NORMAL_TIP = "Transmittance at normal incidence, scattered and unscattered light" | "Transmissionsgrad bei senkrechtem Einfall, gestreutes und ungestreutes Licht";
    const BALANCE = "τ+ρ+α−1" | "τ+ρ+α−1";
    const BALANCE_TIP = "Deviation of the energy balance, largest of all incident directions" | "Abweichung der Energiebilanz, größte aller Einfallsrichtungen";
    const RECIPROCITY = "Reciprocity" | "Reziprozität";
    const RECIPROCITY_TIP = "Share of the flux that contradicts reciprocity" | "Anteil des Lichtstroms, der der Reziprozität widerspricht";
    const ERROR = "Uncertainty" | "Unsicherheit";
    const ERRORS_TIP = "Estimated uncertainty of τ and ρ, largest of all incident directions" | "Geschätzte Unsicherheit von τ und ρ, größte aller Einfallsrichtungen";
    const TIME = "Time" | "Zeit";
    const TIME_TIP = "Wall-clock time" | "Verstrichene Zeit";
    const DESCRIBE_FIRST_HOW = "Describe a system first: an example, a file, or a text" | "Zuerst ein System beschreiben: ein Beispiel, eine Datei oder ein Text";
    const COMPUTE_FIRST = "Compute the system first" | "Zuerst das System berechnen";

    const KLEMS = "Klems 145" | "Klems 145";
    const TREGENZA = "Tregenza 145" | "Tregenza 145";
    fn cells(degrees) = "{degrees}° patches" | "Felder von {degrees}°";

    const VENETIAN = "Venetian" | "Jalousie";
    const LOUVRES = "Vertical louvres" | "Senkrechtlamellen";
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
