//! Texts of importing products: files, questions, findings.

texts! {
    const IMPORT = "Import" | "Import";

    // Actions for files that were read.
    const DROP_HERE = "Drop dataset files, folders, zip archives or packages anywhere on the window, or press Ctrl+O." | "Datensätze, Ordner, ZIP-Archive oder Pakete irgendwo auf das Fenster ziehen oder Strg+O drücken.";
    const UNCHANGED = "The catalogue is unchanged." | "Der Katalog ist unverändert.";
    const ADD_ONE = "Add to catalogue" | "In den Katalog aufnehmen";
    fn add_many(products) = "Add {products} to catalogue" | "{products} in den Katalog aufnehmen";
    const KEEP_DRAFT = "Keep as draft" | "Als Entwurf behalten";
    const KEEP_DRAFT_TIP = "Leave it for later: it is listed here, also after a restart" | "Für später behalten: steht hier in der Liste, auch nach einem Neustart";
    const DISCARD = "Discard" | "Verwerfen";
    const DISCARD_TIP = "Forget what was read; nothing was stored, and Ctrl+Z brings it back" | "Gelesenes vergessen; gespeichert wurde nichts, und Strg+Z holt es zurück";
    const ALL_AS_PROPOSED = "All as proposed" | "Alle wie vorgeschlagen";
    const ALL_AS_PROPOSED_TIP = "Every question is answered by what is proposed" | "Jede Frage wird mit dem Vorschlag beantwortet";
    fn open_questions(questions) = "{questions} open: what they are about stays here." | "{questions} offen: das Betroffene bleibt hier.";
    const RED_BELOW = "What is in red below cannot be stored yet." | "Rot Markiertes lässt sich noch nicht speichern.";
    const ALL_THERE = "All of it is in the catalogue already: below." | "Alles ist schon im Katalog: siehe unten.";
    const ARRANGING = "arranging…" | "wird geordnet…";

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
    const BY_ANGLE_TIP = "Files that differ by an angle alone are states of one product" | "Dateien, die sich nur durch einen Winkel unterscheiden, sind Stellungen eines Produkts";
    const EVERY_FILE = "Every file apart" | "Jede Datei für sich";
    const EVERY_FILE_TIP = "Every file is a product" | "Jede Datei ist ein Produkt";
    const ALL_ONE = "All one product" | "Alles ein Produkt";
    const ALL_ONE_TIP = "Every file is a state of one product" | "Jede Datei ist eine Stellung eines Produkts";
    const BY_HAND = "changed by hand" | "von Hand geändert";
    const CHOOSE_NONE = "Choose none" | "Nichts wählen";
    const CHOOSE_ALL = "Choose all" | "Alles wählen";
    const ONE_OF_THESE = "One product of these" | "Zu einem Produkt";
    const ONE_OF_THESE_TIP = "The files that are chosen are the states of one product" | "Die gewählten Dateien sind die Stellungen eines Produkts";
    const EACH_ITS_OWN = "Each its own" | "Je ein Produkt";
    const EACH_ITS_OWN_TIP = "Every file that is chosen is a product of its own" | "Jede gewählte Datei ist ein eigenes Produkt";
    const STATE_OF = "State of…" | "Stellung von…";
    const STATE_OF_TIP = "The files that are chosen are states of another product here" | "Die gewählten Dateien sind Stellungen eines anderen Produkts hier";
    const CLICK_A_ROW = "Click a row; Shift for a range, Ctrl or Space for more." | "Zeile anklicken; Umschalt für einen Bereich, Strg oder Leertaste für mehr.";
    fn chosen(rows) = "{rows} chosen" | "{rows} gewählt";
    const CONTINUE = "Go on" | "Fortsetzen";
    fn about(what, name) = "{what}: {name}" | "{what}: {name}";
    fn draft_name(first, products) = "{first}: {products}" | "{first}: {products}";
    fn draft_of_many(first, more, products) = "{first} and {more} more: {products}" | "{first} und {more} weitere: {products}";

    // The table.
    const FILE = "File" | "Datei";
    const ANGLE_DEGREES = "Angle [°]" | "Winkel [°]";
    const STATE = "State" | "Stellung";
    const FINDINGS = "Findings" | "Befunde";
    const NOT_READ = "Not read" | "Nicht gelesen";
    const LEFT_OUT = "Left out" | "Ausgelassen";
    const NO_NAME = "(no name)" | "(ohne Namen)";
    fn show_states(name) = "Show the states of {name}" | "Stellungen von {name} zeigen";
    fn fold_states(name) = "Fold the states of {name}" | "Stellungen von {name} einklappen";
    const SEPARATE = "Apart" | "Getrennt";
    const SEPARATE_FILES_TIP = "Every file is a product of its own" | "Jede Datei ist ein eigenes Produkt";
    const SEPARATE_TIP = "It is a product of its own, as proposed" | "Es ist ein eigenes Produkt, wie vorgeschlagen";
    const AS_STATES = "States" | "Stellungen";
    const AS_STATES_TIP = "They are states of one product, as proposed" | "Es sind Stellungen eines Produkts, wie vorgeschlagen";
    const ONE_WITH = "One product" | "Ein Produkt";
    const ONE_WITH_TIP = "It and those are states of one product" | "Es und jene sind Stellungen eines Produkts";
    const ASK_NUMBERS = "Are these states of one product? Only the numbers in the names of the files say so" | "Sind das Stellungen eines Produkts? Nur die Zahlen in den Dateinamen sprechen dafür";
    fn ask_state(others) = "Is it a state of one product with {others}? The names differ by a number alone" | "Ist es eine Stellung desselben Produkts wie {others}? Die Namen unterscheiden sich nur durch eine Zahl";
    fn and_more(others, more) = "{others} and {more} more" | "{others} und {more} weitere";
    fn already_as(name) = "Already in the catalogue as {name}" | "Schon im Katalog als {name}";
    fn same_data(file) = "The same data as {file}" | "Dieselben Daten wie {file}";
    const SHOW_IT = "Show it" | "Zeigen";
    const SHOW_IT_TIP = "Select that product; this sheet stays" | "Dieses Produkt wählen; das Blatt bleibt";
    const ADD_ANYWAY = "Add anyway" | "Trotzdem aufnehmen";
    fn joined_files(count) = "{count} files of one function each" | "{count} Dateien mit je einer Funktion";
    const ANGLE = "Angle" | "Winkel";
    const STATE_NAME = "State name" | "Name der Stellung";
    fn of_file(what, file) = "{what} of {file}" | "{what} von {file}";

    // Reasons why something cannot be stored.
    fn no_transmission(file) = "{file} tells no visible transmission, and cannot be stored" | "{file} enthält keine sichtbare Transmission und lässt sich nicht speichern";
    const NAME_MISSING = "A name is missing" | "Ein Name fehlt";
    fn no_angle(text) = "“{text}” is no angle; expected a number of degrees" | "„{text}“ ist kein Winkel; erwartet wird eine Zahl in Grad";
    const NAMELESS_STATE = "A state has neither an angle nor a name" | "Eine Stellung hat weder Winkel noch Namen";
    fn same_key(key) = "Two states are called {key}" | "Zwei Stellungen heißen {key}";

    // Beside the table.
    fn about_products(products) = "About {products}" | "Angaben zu {products}";
    const ABOUT_IT = "About it" | "Angaben dazu";
    const DIFFERENT = "different" | "verschieden";
    const FOR_ALL = "What is typed here is written for all of them." | "Eingaben hier gelten für alle.";
    fn bases(format, incident, emergent) = "{format}; incident {incident}, emergent {emergent}" | "{format}; Einfall {incident}, Austritt {emergent}";
    fn taus(normal, hemispherical) = "τ {normal} normal, {hemispherical} hemispherical" | "τ {normal} senkrecht, {hemispherical} hemisphärisch";
    const TURN = "Turn upside down" | "Auf den Kopf stellen";
    const MIRROR = "Mirror left and right" | "Links und rechts spiegeln";
    const TURN_HALF = "Turn by 180°" | "Um 180° drehen";
    const SWAP_SIDES = "Swap outside and inside" | "Außen und innen tauschen";
    const TRANSPOSE = "Exchange incident and emergent" | "Einfall und Austritt tauschen";
    const DIVIDE_100 = "Divide by 100" | "Durch 100 teilen";
    const MULTIPLY_100 = "Multiply by 100" | "Mit 100 malnehmen";
    const DIVIDE_COSINE = "Divide by the cosine" | "Durch den Kosinus teilen";
    const MULTIPLY_COSINE = "Multiply by the cosine" | "Mit dem Kosinus malnehmen";
    const DIVIDE_ANGLE = "Divide by the solid angle" | "Durch den Raumwinkel teilen";
    const MULTIPLY_ANGLE = "Multiply by the solid angle" | "Mit dem Raumwinkel malnehmen";
    const DROP_BLOCK = "Leave the block out" | "Block weglassen";
    const DERIVE = "Derive by reciprocity" | "Aus der Reziprozität ableiten";
    const CLAMP = "Set negative values to 0" | "Negative Werte auf 0 setzen";
    const TURN_TIP = "Up and down exchanged in all states of this product; the picture shows what comes of it" | "Oben und unten in allen Stellungen dieses Produkts vertauscht; das Bild zeigt die Wirkung";
    const UNDO_REPAIR = "Undo the repair" | "Reparatur rückgängig";
    const UNDO_REPAIR_TIP = "Take the last repair back" | "Letzte Reparatur zurücknehmen";
    fn repairing(repairs) = "Repairing: {repairs}" | "Wird repariert: {repairs}";
    fn repaired(repairs) = "Repaired: {repairs}" | "Repariert: {repairs}";
    const NO_FINDINGS = "No findings" | "Keine Befunde";
    fn findings(counts) = "Findings: {counts}" | "Befunde: {counts}";
    const NOTHING_TO_SAY = "The checks have nothing to say." | "Die Prüfung hat nichts zu beanstanden.";
    const CHECKING = "Checking the data…" | "Daten werden geprüft…";
    const ERROR = "error" | "Fehler";
    const WARNING = "warning" | "Warnung";
    const INFO = "info" | "Hinweis";
    fn titled(severity, title) = "{severity}: {title}" | "{severity}: {title}";
    const SURE = "Beyond doubt. Nothing is stored yet, and it can be undone" | "Zweifelsfrei. Noch ist nichts gespeichert, und es lässt sich zurücknehmen";
    const UNSURE = "A question: only if it is so for the product. Try it: nothing is stored, and it can be undone" | "Eine Frage: nur, wenn es für das Produkt stimmt. Versuchen: nichts wird gespeichert, und es lässt sich zurücknehmen";
    fn sun_at_45(tau, up, down) = "Sun at 45° altitude, perpendicular to the façade in plan: τ {tau}; {up} % of the transmitted light goes up, {down} % down" | "Sonne in 45° Höhe, im Grundriss senkrecht zur Fassade: τ {tau}; vom durchgelassenen Licht gehen {up} % nach oben, {down} % nach unten";
    const PICTURE_TIP = "Section: outside on the left; if it is not so, up and down or the sides are exchanged" | "Schnitt: außen links; stimmt das nicht, sind oben und unten oder die Seiten vertauscht";

    // Messages after a change.
    fn kept(name) = "Kept as a draft: {name}. The import sheet (I) lists it" | "Als Entwurf behalten: {name}. Das Blatt Import (I) listet ihn";
    fn discarded(name) = "Discarded: {name}. Ctrl+Z brings it back" | "Verworfen: {name}. Strg+Z holt es zurück";
    fn nothing_added(error) = "Nothing was added: {error}" | "Nichts wurde aufgenommen: {error}";
    const NOT_OPEN = "The import that this step belongs to is no longer open" | "Der Import, zu dem dieser Schritt gehört, ist nicht mehr offen";
}
