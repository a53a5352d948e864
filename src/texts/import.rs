//! Texts of importing products: files, questions, findings.

texts! {
    const IMPORT = "Import" | "Import";

    // Actions for files that were read.
    const DROP_HERE = "Drop dataset files, folders, zip archives or packages anywhere on the window, or press Ctrl+O." | "Datensätze, Ordner, ZIP-Archive oder Pakete irgendwo auf das Fenster ziehen oder Strg+O drücken.";
    const UNCHANGED = "The catalogue is unchanged." | "Der Katalog ist unverändert.";
    const ADD_ONE = "Add to catalogue" | "Zum Katalog hinzufügen";
    fn add_many(products) = "Add {products} to catalogue" | "{products} zum Katalog hinzufügen";
    const KEEP_DRAFT = "Keep as draft" | "Als Entwurf behalten";
    const KEEP_DRAFT_TIP = "Keeps the import for later; it is listed here, also after a restart" | "Behält den Import für später; er steht hier in der Liste, auch nach einem Neustart";
    const DISCARD = "Discard" | "Verwerfen";
    const DISCARD_TIP = "Discards the import without storing anything; Ctrl+Z restores it" | "Verwirft den Import, ohne etwas zu speichern; Strg+Z stellt ihn wieder her";
    const ALL_AS_PROPOSED = "Accept all proposals" | "Alle Vorschläge annehmen";
    const ALL_AS_PROPOSED_TIP = "Answers every question as proposed" | "Beantwortet jede Frage wie vorgeschlagen";
    fn open_questions(questions) = "{questions} open: the files concerned stay here." | "{questions} offen: die betroffenen Dateien bleiben hier.";
    const RED_BELOW = "Entries marked red cannot be stored yet." | "Rot Markiertes lässt sich noch nicht speichern.";
    const ALL_THERE = "Everything is already in the catalogue: see below." | "Alles ist schon im Katalog: siehe unten.";
    const ARRANGING = "grouping…" | "wird zugeordnet…";

    // Counts.
    const ONE_PRODUCT = "1 product" | "1 Produkt";
    fn products(count) = "{count} products" | "{count} Produkte";
    const ONE_STATE = "1 state" | "1 Stellung";
    fn states(count) = "{count} states" | "{count} Stellungen";
    const ONE_QUESTION = "1 question" | "1 Frage";
    fn questions(count) = "{count} questions" | "{count} Fragen";
    const ONE_ROW = "1 row" | "1 Zeile";
    fn rows(count) = "{count} rows" | "{count} Zeilen";
    const ONE_DRAFT = "1 draft" | "1 Entwurf";
    fn drafts(count) = "{count} drafts" | "{count} Entwürfe";
    const ONE_FILE = "1 file" | "1 Datei";
    fn files(count) = "{count} files" | "{count} Dateien";
    const ONE_ERROR = "1 error" | "1 Fehler";
    fn errors(count) = "{count} errors" | "{count} Fehler";
    const ONE_WARNING = "1 warning" | "1 Warnung";
    fn warnings(count) = "{count} warnings" | "{count} Warnungen";
    const ONE_NOTE = "1 note" | "1 Hinweis";
    fn notes(count) = "{count} notes" | "{count} Hinweise";
    fn products_of_states(products, states) = "{products} of {states}" | "{products}, {states}";

    // Ways of grouping files.
    const BY_ANGLE = "By angle" | "Nach Winkel";
    const BY_ANGLE_TIP = "Groups files that differ only by an angle as states of one product" | "Fasst Dateien, die sich nur durch einen Winkel unterscheiden, als Stellungen eines Produkts zusammen";
    const EVERY_FILE = "One product per file" | "Ein Produkt je Datei";
    const EVERY_FILE_TIP = "Makes every file a product" | "Macht jede Datei zu einem Produkt";
    const ALL_ONE = "All one product" | "Alles ein Produkt";
    const ALL_ONE_TIP = "Makes every file a state of one product" | "Macht jede Datei zur Stellung eines Produkts";
    const BY_HAND = "changed by hand" | "von Hand geändert";
    const CHOOSE_NONE = "Select none" | "Nichts wählen";
    const CHOOSE_ALL = "Select all" | "Alles wählen";
    const ONE_OF_THESE = "Make one product" | "Zu einem Produkt";
    const ONE_OF_THESE_TIP = "Makes the selected files states of one product" | "Macht die gewählten Dateien zu Stellungen eines Produkts";
    const EACH_ITS_OWN = "Make separate products" | "Je ein Produkt";
    const EACH_ITS_OWN_TIP = "Makes every selected file a product" | "Macht jede gewählte Datei zu einem Produkt";
    const STATE_OF = "State of…" | "Stellung von…";
    const STATE_OF_TIP = "Makes the selected files states of another product of this import" | "Macht die gewählten Dateien zu Stellungen eines anderen Produkts dieses Imports";
    const CLICK_A_ROW = "Click a row; Shift for a range, Ctrl or Space for more." | "Zeile anklicken; Umschalt für einen Bereich, Strg oder Leertaste für mehr.";
    fn chosen(rows) = "{rows} selected" | "{rows} gewählt";
    const CONTINUE = "Continue" | "Fortsetzen";
    fn about(what, name) = "{what}: {name}" | "{what}: {name}";
    fn draft_name(first, products) = "{first}: {products}" | "{first}: {products}";
    fn draft_of_many(first, more, products) = "{first} and {more} more: {products}" | "{first} und {more} weitere: {products}";

    // The table.
    const FILE = "File" | "Datei";
    const ANGLE_DEGREES = "Angle [°]" | "Winkel [°]";
    const STATE = "State" | "Stellung";
    const FINDINGS = "Findings" | "Befunde";
    const NOT_READ = "Not read" | "Nicht gelesen";
    const LEFT_OUT = "Skipped" | "Ausgelassen";
    const NO_NAME = "(no name)" | "(ohne Namen)";
    fn show_states(name) = "Show the states of {name}" | "Stellungen von {name} zeigen";
    fn fold_states(name) = "Hide the states of {name}" | "Stellungen von {name} einklappen";
    const SEPARATE = "Separate" | "Getrennt";
    const SEPARATE_FILES_TIP = "Makes every file a product, as proposed" | "Macht jede Datei zu einem Produkt, wie vorgeschlagen";
    const SEPARATE_TIP = "Makes it a separate product, as proposed" | "Macht sie zu einem eigenen Produkt, wie vorgeschlagen";
    const AS_STATES = "States" | "Stellungen";
    const AS_STATES_TIP = "Makes them states of one product, as proposed" | "Macht sie zu Stellungen eines Produkts, wie vorgeschlagen";
    const ONE_WITH = "One product" | "Ein Produkt";
    const ONE_WITH_TIP = "Makes all of them states of one product" | "Macht alle zu Stellungen eines Produkts";
    const ASK_NUMBERS = "Are these states of one product? Only numbers in the file names suggest it" | "Sind das Stellungen eines Produkts? Nur Zahlen in den Dateinamen sprechen dafür";
    fn ask_state(others) = "Is it a state of one product with {others}? The names differ only by a number" | "Ist es eine Stellung desselben Produkts wie {others}? Die Namen unterscheiden sich nur durch eine Zahl";
    fn and_more(others, more) = "{others} and {more} more" | "{others} und {more} weitere";
    fn already_as(name) = "Already in the catalogue as {name}" | "Schon im Katalog als {name}";
    fn same_data(file) = "The same data as {file}" | "Dieselben Daten wie {file}";
    const SHOW_IT = "Show" | "Zeigen";
    const SHOW_IT_TIP = "Selects that product; this sheet stays open" | "Wählt dieses Produkt; das Blatt bleibt offen";
    const ADD_ANYWAY = "Add anyway" | "Trotzdem hinzufügen";
    fn joined_files(count) = "{count} files of one function each" | "{count} Dateien mit je einer Funktion";
    const ANGLE = "Angle" | "Winkel";
    const STATE_NAME = "State name" | "Name der Stellung";
    fn of_file(what, file) = "{what} of {file}" | "{what} von {file}";

    // Reasons why something cannot be stored.
    fn no_transmission(file) = "{file} contains no visible transmission and cannot be stored" | "{file} enthält keine sichtbare Transmission und lässt sich nicht speichern";
    const NAME_MISSING = "A name is missing" | "Ein Name fehlt";
    fn no_angle(text) = "“{text}” is not an angle; expected a number of degrees" | "„{text}“ ist kein Winkel; erwartet wird eine Zahl in Grad";
    const NAMELESS_STATE = "A state has neither an angle nor a name" | "Eine Stellung hat weder Winkel noch Namen";
    fn same_key(key) = "Two states have the same key {key}" | "Zwei Stellungen haben denselben Schlüssel {key}";

    // Beside the table.
    fn about_products(products) = "Details of {products}" | "Angaben zu {products}";
    const ABOUT_IT = "Details" | "Angaben";
    const DIFFERENT = "several values" | "verschieden";
    const FOR_ALL = "Entries here apply to all of them." | "Eingaben hier gelten für alle.";
    fn bases(format, incident, emergent) = "{format}; incident {incident}, emergent {emergent}" | "{format}; Einfall {incident}, Austritt {emergent}";
    fn taus(normal, hemispherical) = "τ {normal} normal, {hemispherical} hemispherical" | "τ {normal} senkrecht, {hemispherical} hemisphärisch";
    const TURN = "Turn upside down" | "Auf den Kopf stellen";
    const MIRROR = "Mirror left and right" | "Links und rechts spiegeln";
    const TURN_HALF = "Turn by 180°" | "Um 180° drehen";
    const SWAP_SIDES = "Swap outside and inside" | "Außen und innen tauschen";
    const TRANSPOSE = "Swap incident and emergent" | "Einfall und Austritt tauschen";
    const DIVIDE_100 = "Divide by 100" | "Durch 100 teilen";
    const MULTIPLY_100 = "Multiply by 100" | "Mit 100 multiplizieren";
    const DIVIDE_COSINE = "Divide by the cosine" | "Durch den Kosinus teilen";
    const MULTIPLY_COSINE = "Multiply by the cosine" | "Mit dem Kosinus multiplizieren";
    const DIVIDE_ANGLE = "Divide by the solid angle" | "Durch den Raumwinkel teilen";
    const MULTIPLY_ANGLE = "Multiply by the solid angle" | "Mit dem Raumwinkel multiplizieren";
    const DROP_BLOCK = "Remove the block" | "Block entfernen";
    const DERIVE = "Derive by reciprocity" | "Aus der Reziprozität ableiten";
    const CLAMP = "Set negative values to 0" | "Negative Werte auf 0 setzen";
    const TURN_TIP = "Swaps up and down in all states of this product; the picture shows the effect" | "Vertauscht oben und unten in allen Stellungen dieses Produkts; das Bild zeigt die Wirkung";
    const UNDO_REPAIR = "Undo the repair" | "Reparatur rückgängig";
    const UNDO_REPAIR_TIP = "Undoes the last repair" | "Nimmt die letzte Reparatur zurück";
    fn repairing(repairs) = "Repairing: {repairs}" | "Wird repariert: {repairs}";
    fn repaired(repairs) = "Repaired: {repairs}" | "Repariert: {repairs}";
    const NO_FINDINGS = "No findings" | "Keine Befunde";
    fn findings(counts) = "Findings: {counts}" | "Befunde: {counts}";
    const NOTHING_TO_SAY = "The data check has no findings." | "Die Datenprüfung hat keine Befunde.";
    const CHECKING = "Checking the data…" | "Daten werden geprüft…";
    const ERROR = "error" | "Fehler";
    const WARNING = "warning" | "Warnung";
    const INFO = "info" | "Hinweis";
    fn titled(severity, title) = "{severity}: {title}" | "{severity}: {title}";
    const SURE = "Certain: repairs the data; nothing is stored yet, and it can be undone" | "Sicher: repariert die Daten; noch ist nichts gespeichert, und es lässt sich zurücknehmen";
    const UNSURE = "Possible: repairs the data, if this is true of the product; nothing is stored yet, and it can be undone" | "Möglich: repariert die Daten, falls es für das Produkt zutrifft; noch ist nichts gespeichert, und es lässt sich zurücknehmen";
    fn sun_at_45(tau, up, down) = "Direct sun at 45° altitude, perpendicular to the façade in plan: τ {tau}; of the transmitted light {up} % leaves upwards, {down} % downwards" | "Direktes Sonnenlicht bei 45° Sonnenhöhe, im Grundriss senkrecht zur Fassade: τ {tau}; vom durchgelassenen Licht gehen {up} % nach oben, {down} % nach unten";
    const PICTURE_TIP = "Section with outside on the left; if the product differs, up and down or the sides are swapped" | "Schnitt mit außen links; weicht das Produkt ab, sind oben und unten oder die Seiten vertauscht";

    // Messages after a change.
    fn kept(name) = "Kept as a draft: {name}. It is listed in the import sheet (I)" | "Als Entwurf behalten: {name}. Er steht im Importblatt (I)";
    fn discarded(name) = "Discarded: {name}. Ctrl+Z restores it" | "Verworfen: {name}. Strg+Z stellt es wieder her";
    fn nothing_added(error) = "Nothing was added: {error}" | "Nichts wurde hinzugefügt: {error}";
    const NOT_OPEN = "The import of this step is no longer open" | "Der Import dieses Schritts ist nicht mehr offen";
}
