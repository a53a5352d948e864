//! Texts of the product list: search, facets, gallery, collections; changes of stored products.

texts! {
    // The panel.
    const CATALOGUE = "Catalogue" | "Katalog";
    const OPENING = "Opening the catalogue…" | "Katalog wird geöffnet…";
    const TRY_AGAIN = "Try again" | "Erneut versuchen";
    const SEARCH = "Search" | "Suchen";
    const SEARCH_HINT = "Search (Ctrl+F)" | "Suchen (Strg+F)";
    const GALLERY = "Gallery" | "Galerie";
    const GALLERY_TIP = "Products as pictures: where the sun goes, in the state that stands for each" | "Produkte als Bilder: wohin die Sonne geht, in der Stellung, die für jedes steht";
    const ONE_STATE = "One state" | "Eine Stellung";
    fn state_of(state, count, does) = "State {state} of {count}, {does}" | "Stellung {state} von {count}, {does}";
    fn step_states(line) = "{line}; [ and ] step through the states" | "{line}; [ und ] schalten weiter";

    const LANE_GALLERY = "pictures of products" | "Bilder der Produkte";
    const LANE_FINDINGS = "findings" | "Befunde";

    // A row.
    fn at_angle(state) = " at {state}°" | " bei {state}°";
    fn in_state(state) = " ({state})" | " ({state})";
    fn states(count) = "{count} states" | "{count} Stellungen";
    fn from_folder(folder) = "from {folder}" | "aus {folder}";
    fn only_read(folder) = "from {folder}, only read" | "aus {folder}, nur gelesen";
    fn tau_tip(normal, uniform) = "τ at normal incidence {normal}, under uniform light {uniform}" | "τ bei senkrechtem Einfall {normal}, bei gleichmäßigem Licht {uniform}";
    fn states_tip(count, state) = "{count} states; the picture is of the one{state}" | "{count} Stellungen; das Bild zeigt die{state}";
    const PICTURE_TIP = "The picture: where the light of a sun 40° high goes, seen from inside, up is up; three decades below its own greatest value" | "Das Bild: wohin das Licht einer 40° hohen Sonne geht, von innen gesehen, oben ist oben; drei Dekaden unter dem eigenen Höchstwert";
    fn from_like(name, distance) = "From {name}: {distance}" | "Von {name}: {distance}";
    fn take_star(name) = "Take the star of {name}" | "Stern entfernen: {name}";
    fn set_star(name) = "Star {name}" | "Stern setzen: {name}";
    const REMOVE_FROM_COMPARISON = "Take out of the comparison" | "Aus dem Vergleich nehmen";
    const REMOVE_FROM_COMPARISON_TIP = "In the tray; a click takes it out" | "In der Vergleichsliste; ein Klick nimmt es heraus";
    const COMPARE = "Compare" | "Vergleichen";
    const COMPARE_TIP = "Add to the tray of what is compared" | "In die Vergleichsliste aufnehmen";
    fn about(what, name) = "{what}: {name}" | "{what}: {name}";
    const LIKE_THIS = "Products like this" | "Ähnliche Produkte";
    const LIKE_THIS_TIP = "By what they do to light, nearest first" | "Nach ihrer Wirkung auf das Licht, die ähnlichsten zuerst";
    const RENAME = "Rename…" | "Umbenennen…";
    const RENAME_TIP = "Name, maker, kind and tags" | "Name, Hersteller, Art und Schlagwörter";
    const DELETE = "Delete" | "Löschen";
    const DELETE_TIP = "Out of sight; undo or Recently deleted brings it back" | "Ausgeblendet; Rückgängig oder „Zuletzt gelöscht“ holt es zurück";

    // Facets.
    const NOT_SPECIFIED = "not told" | "keine Angabe";
    fn filter_by(title) = "Filter by {title}" | "Filter: {title}";
    const NONE_SPECIFIED = "No product tells it" | "Kein Produkt gibt es an";
    const STARRED_ALONE = "Starred products alone" | "Nur Produkte mit Stern";
    const RECENT = "Recent" | "Zuletzt benutzt";
    const RECENT_ALONE = "Products shown last alone, the last first" | "Nur zuletzt gezeigte Produkte, das letzte zuerst";
    const KIND = "Kind" | "Art";
    const MAKER = "Maker" | "Hersteller";
    const MOVES = "Moves" | "Beweglich";
    const DATA = "Data" | "Daten";
    const FIGURES = "Figures" | "Kennwerte";
    const TAGS = "Tags" | "Schlagwörter";
    const COLLECTIONS = "Collections" | "Sammlungen";
    const KIND_FACET = "kind" | "Art";
    const MAKER_FACET = "maker" | "Hersteller";
    const MOVES_FACET = "moves" | "Beweglichkeit";
    const DATA_FACET = "data" | "Daten";
    const FIGURES_FACET = "figures" | "Kennwerte";
    const TAGS_FACET = "tags" | "Schlagwörter";
    const COLLECTIONS_FACET = "collections" | "Sammlungen";
    const MOVING = "moving" | "beweglich";
    const FIXED = "fixed" | "fest";
    const MEASURED = "measured" | "gemessen";
    const COMPUTED = "computed" | "berechnet";
    const UNKNOWN = "unknown" | "unbekannt";
    const BUILT_IN = "built in" | "mitgeliefert";
    const YOUR_OWN = "your own" | "eigene";
    const STARRED = "starred" | "mit Stern";
    const NOT_STARRED = "not starred" | "ohne Stern";
    const RECENT_CHIP = "recent" | "zuletzt benutzt";
    const OR = " or " | " oder ";
    const AND = " and " | " und ";
    fn between(low, high) = "{low} to {high}" | "{low} bis {high}";
    fn from(low) = "from {low}" | "ab {low}";
    fn below(high) = "below {high}" | "unter {high}";
    const ANY = "any" | "beliebig";
    fn takes_out(words) = "{words}: a click takes this filter out" | "{words}: ein Klick hebt diesen Filter auf";
    fn without(words) = "Without {words}" | "Ohne {words}";
    const CLEAR = "Clear" | "Alle aufheben";
    const CLEAR_ALL = "Take all filters out" | "Alle Filter aufheben";
    fn count_of(found, total) = "{found} of {total}" | "{found} von {total}";
    fn products_fit(found, total) = "{found} of {total} products fit" | "{found} von {total} Produkten passen";
    const FALLING = "Falling order" | "Absteigend";
    const RISING = "Rising order" | "Aufsteigend";
    fn turn_round(order) = "{order}; a click turns it round" | "{order}; ein Klick kehrt um";
    const ORDER_TIP = "Order of the list" | "Reihenfolge der Liste";
    const ORDER = "Order" | "Reihenfolge";
    fn read_as(typed, read_as) = "No product has “{typed}”: read as “{read_as}”" | "Kein Produkt enthält „{typed}“: gelesen als „{read_as}“";
    fn like(name) = "Like {name} ×" | "Wie {name} ×";
    fn like_tip(name) = "Products by what they do to light, nearest to {name} first: differences of τ, its profile, light to the ceiling, sun blocked and view, all as shares of the light that arrives. A click goes back to the list" | "Produkte nach ihrer Wirkung auf das Licht, {name} am ähnlichsten zuerst: Unterschiede von τ, Profil, Licht zur Decke, Sonnenschutz und Durchsicht, alle als Anteile des auftreffenden Lichts. Ein Klick führt zurück zur Liste";
    fn no_longer_like(name) = "No longer like {name}" | "Nicht mehr wie {name}";
    const NO_PRODUCT_YET = "The catalogue holds no product yet: open a file to put one in." | "Der Katalog ist noch leer: eine Datei öffnen, um ein Produkt aufzunehmen.";
    const NOT_ALL_WORDS = "Nothing has all these words." | "Kein Produkt enthält alle diese Wörter.";
    const NOT_WORDS_AND_FILTERS = "Nothing has all these words and passes the filters." | "Kein Produkt enthält alle diese Wörter und passt zu den Filtern.";
    const NOT_ALL_FILTERS = "Nothing passes all the filters." | "Kein Produkt passt zu allen Filtern.";
    fn one_without(what) = "1 product without “{what}”" | "1 Produkt ohne „{what}“";
    fn more_without(count, what) = "{count} products without “{what}”" | "{count} Produkte ohne „{what}“";
    const SHOW_ALL = "Show all" | "Alle zeigen";

    // Damages.
    fn restored(keys) = "Damaged in the catalogue, and restored from what the program contains: {keys}. The disk may be failing: keep a copy, and run `cfs catalogue check`." | "Im Katalog beschädigt und aus dem Bestand des Programms wiederhergestellt: {keys}. Der Datenträger ist möglicherweise fehlerhaft: eine Kopie aufbewahren und `cfs catalogue check` ausführen.";
    fn not_listed(keys) = "Not listed, because damaged in the catalogue: {keys}. `cfs catalogue check --repair` restores what can be restored; import the rest again." | "Nicht aufgeführt, da im Katalog beschädigt: {keys}. `cfs catalogue check --repair` stellt wieder her, was sich wiederherstellen lässt; den Rest erneut importieren.";

    // Figures and orders.
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_HEMISPHERICAL = "τ hemispherical" | "τ hemisphärisch";
    const TO_CEILING = "Light to the ceiling" | "Licht zur Decke";
    const SUN_BLOCKED = "Sun blocked" | "Sonnenschutz";
    const VIEW = "View" | "Durchsicht";
    const BEST_MATCH = "Best match" | "Beste Treffer";
    const NAME = "Name" | "Name";
    const STATES = "States" | "Stellungen";
    fn distance_is(distance, parts) = "{distance} apart: {parts}" | "Abstand {distance}: {parts}";
    fn no_difference(least) = "no difference above {least}" | "kein Unterschied über {least}";
    const DISTANCE_TAU = "τ" | "τ";
    const DISTANCE_PROFILE = "profile" | "Profil";
    const DISTANCE_CEILING = "ceiling" | "Decke";
    const DISTANCE_SUN = "sun blocked" | "Sonnenschutz";
    const DISTANCE_VIEW = "view" | "Durchsicht";

    // Collections, recent products, subscriptions.
    const COLLECTIONS_MENU = "Collections…" | "Sammlungen…";
    const COLLECTIONS_TIP = "Sets of products that you make and name; the selected product in or out of them" | "Selbst benannte Gruppen von Produkten; das gewählte Produkt aufnehmen oder herausnehmen";
    const GALLERY_MENU = "Products as a gallery or a list" | "Produkte als Galerie oder Liste";
    const RECENT_MENU = "Recent products alone, or all" | "Nur zuletzt benutzte Produkte oder alle";
    const STAR_MENU = "Star the product, or take its star" | "Stern des Produkts setzen oder entfernen";
    const STAR_MENU_TIP = "Starred products can be shown alone" | "Produkte mit Stern lassen sich allein zeigen";
    const FIRST_MENU = "Choose the first product of the list" | "Erstes Produkt der Liste wählen";
    const FIRST_MENU_TIP = "It gets the keyboard; arrow keys go on from there" | "Es bekommt die Tastatur; die Pfeiltasten gehen von dort weiter";
    const SUBSCRIBE_MENU = "Subscribe to a folder…" | "Ordner abonnieren…";
    const SUBSCRIBE_TIP = "Products of the packages in a shared folder are listed among the others, and read anew when they change" | "Produkte der Pakete eines gemeinsamen Ordners stehen in der Liste und werden bei Änderungen neu gelesen";
    const SUBSCRIPTIONS = "Subscribed folders" | "Abonnierte Ordner";
    const SUBSCRIPTIONS_MENU = "Subscribed folders…" | "Abonnierte Ordner…";
    const SUBSCRIPTIONS_TIP = "Folders of packages, and the end of a subscription" | "Ordner mit Paketen, und Abonnements beenden";
    const SUBSCRIBE = "Subscribe" | "Abonnieren";
    const SUBSCRIBE_TITLE = "Subscribe to a folder" | "Ordner abonnieren";
    const SUBSCRIBE_HINT = "A folder of packages (.cfsp), e.g. on a file share: its products are listed among the others, only read." | "Ordner mit Paketen (.cfsp), z. B. auf einem Netzlaufwerk: seine Produkte stehen in der Liste, nur gelesen.";
    const UNSUBSCRIBE = "Unsubscribe" | "Abonnement beenden";
    const UNSUBSCRIBE_TIP = "Its products leave the list; Ctrl+Z brings them back" | "Seine Produkte verlassen die Liste; Strg+Z holt sie zurück";
    const NO_SUBSCRIPTION = "No folder is subscribed to." | "Kein Ordner ist abonniert.";
    fn products_from(count) = "Products: {count}" | "Produkte: {count}";
    fn unsubscribed(folder) = "No longer subscribed: {folder}. Ctrl+Z brings its products back" | "Nicht mehr abonniert: {folder}. Strg+Z holt seine Produkte zurück";
    fn subscribed_now(folder) = "Subscribed: {folder}. Ctrl+Z ends the subscription" | "Abonniert: {folder}. Strg+Z beendet das Abonnement";
    fn subscribed_already(folder) = "Subscribed already: {folder}. It is read anew" | "Bereits abonniert: {folder}. Der Ordner wird neu gelesen";
    const NEW_COLLECTION = "New collection" | "Neue Sammlung";
    const ADD = "Add" | "Hinzufügen";
    const ADD_TIP = "A new collection with this product in it" | "Neue Sammlung mit diesem Produkt";
    fn members(name, count) = "{name}  {count}" | "{name}  {count}";
    const NO_COLLECTION = "No collection yet: name one, and the product above is its first." | "Noch keine Sammlung: einen Namen eingeben, das Produkt oben ist ihr erstes.";
    const COLLECTIONS_HELP = "A mark: this product is in the collection. Products of a collection are found by the facet of the same name." | "Ein Haken: Das Produkt gehört zur Sammlung. Der gleichnamige Filter zeigt die Produkte einer Sammlung.";
    const DISBAND = "Disband" | "Auflösen";
    const DISBAND_TIP = "Take all products out of it; they stay in the catalogue, and Ctrl+Z brings the collection back" | "Alle Produkte herausnehmen; sie bleiben im Katalog, und Strg+Z holt die Sammlung zurück";
    const SHOW = "Show" | "Zeigen";
    const SHOW_TIP = "The list shows the products of this collection alone" | "Die Liste zeigt nur die Produkte dieser Sammlung";

    // A product's sheet.
    const MANUFACTURER = "Manufacturer" | "Hersteller";
    const AUTHOR = "Author" | "Verfasser";
    const LICENSE = "License" | "Lizenz";
    const LICENSE_HINT = "e.g. CC BY 4.0" | "z. B. CC BY 4.0";
    const NONE_SELECTED = "No product is selected." | "Kein Produkt gewählt.";
    fn key_in_scenes(key) = "Key in scenes: {key}" | "Schlüssel in Szenen: {key}";
    fn of_subscription(folder) = "It comes from {folder}, which is subscribed to, and is only read." | "Es kommt aus dem abonnierten Ordner {folder} und wird nur gelesen.";
    const OF_PROGRAM = "It comes with the program and keeps its name, kind and tags. It can be deleted, which takes it out of sight." | "Es ist mitgeliefert und behält Name, Art und Schlagwörter. Löschen blendet es aus.";
    const SAVE = "Save" | "Speichern";
    const DELETE_PRODUCT = "Delete product" | "Produkt löschen";
    const DELETE_PRODUCT_TIP = "Out of sight; it can be brought back" | "Wird ausgeblendet; es lässt sich zurückholen";
    const KEY = "Key" | "Schlüssel";
    const ANGLE_DEGREES = "Angle [°]" | "Winkel [°]";
    const ANGLE = "Angle" | "Winkel";
    const THE_ONLY_ONE = "the only one" | "die einzige";
    fn of_state(what, state) = "{what} of state {state}" | "{what} der Stellung {state}";
    const REPLACE = "Replace…" | "Ersetzen…";
    const REPLACE_TIP = "Other data for this state, from a file" | "Andere Daten für diese Stellung, aus einer Datei";
    fn replace_state(state) = "Replace state {state}" | "Stellung {state} ersetzen";
    const FILES = "Files" | "Dateien";
    const READ_AGAIN = "Read its files again" | "Dateien neu lesen";
    const READ_AGAIN_TIP = "What is not as it was is shown before it is taken" | "Änderungen werden gezeigt, bevor sie übernommen werden";
    const NOTHING_CHANGED = "Nothing has changed since they were read." | "Seit dem Lesen hat sich nichts geändert.";
    const TAKE_CHANGES = "Take the changes" | "Änderungen übernehmen";
    const TAKE_CHANGES_TIP = "Ctrl+Z brings the data of before back" | "Strg+Z stellt die vorigen Daten wieder her";
    const HISTORY = "History" | "Verlauf";
    const NO_HISTORY = "Nothing is written down." | "Nichts verzeichnet.";
    const DELETED_HELP = "Out of sight, and kept. Scenes that name them still work." | "Ausgeblendet, aber aufbewahrt. Szenen, die sie nennen, funktionieren weiter.";
    const NONE_DELETED = "No product is deleted." | "Kein Produkt ist gelöscht.";
    fn at_built_in(at) = "{at}, built in" | "{at}, mitgeliefert";
    const RESTORE = "Restore" | "Wiederherstellen";
    fn restore(name) = "Restore {name}" | "{name} wiederherstellen";
    const NEEDS_A_NAME = "It needs a name." | "Ein Name fehlt.";
    fn no_angle(text) = "“{text}” is no angle; expected a number of degrees." | "„{text}“ ist kein Winkel; erwartet wird eine Zahl in Grad.";

    // Messages after a change.
    const DELETED_ALREADY = "It is deleted already; choose another product" | "Bereits gelöscht; ein anderes Produkt wählen";
    fn deleted(name) = "Deleted: {name}. Ctrl+Z, or Recently deleted in the Edit menu, brings it back" | "Gelöscht: {name}. Strg+Z oder „Zuletzt gelöscht“ im Menü Bearbeiten holt es zurück";
    fn synced(taken, gone) = "Subscribed folders: {taken} products came or changed, {gone} went" | "Abonnierte Ordner: {taken} Produkte neu oder geändert, {gone} entfallen";
    const REPLACED = "Replaced; Ctrl+Z takes the new data out again" | "Ersetzt; Strg+Z nimmt die neuen Daten wieder heraus";
    const TAKEN = "Taken; Ctrl+Z brings the data of before back" | "Übernommen; Strg+Z stellt die vorigen Daten wieder her";
    fn tau_becomes(file, before, after) = "{file}: τ {before} becomes {after}" | "{file}: aus τ {before} wird {after}";
}
