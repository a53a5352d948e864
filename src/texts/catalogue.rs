//! Texts of the product list: search, facets, gallery, collections; changes of stored products.

texts! {
    // The panel.
    const CATALOGUE = "Catalogue" | "Katalog";
    const OPENING = "Opening the catalogue…" | "Katalog wird geöffnet…";
    const TRY_AGAIN = "Try again" | "Erneut versuchen";
    const SEARCH = "Search" | "Suchen";
    const SEARCH_HINT = "Search (Ctrl+F)" | "Suchen (Strg+F)";
    const GALLERY = "Gallery" | "Galerie";
    const GALLERY_TIP = "Shows the products as pictures: where direct sunlight goes, in the representative state of each" | "Zeigt die Produkte als Bilder: wohin direktes Sonnenlicht geht, in der maßgebenden Stellung";
    const ONE_STATE = "One state" | "Eine Stellung";
    fn state_of(state, count, does) = "State {state} of {count}, {does}" | "Stellung {state} von {count}, {does}";
    fn step_states(line) = "{line}; [ and ] step through the states" | "{line}; [ und ] wechseln die Stellung";

    const LANE_GALLERY = "pictures of products" | "Bilder der Produkte";
    const LANE_FINDINGS = "findings" | "Befunde";

    // A row.
    fn at_angle(state) = " at {state}°" | " bei {state}°";
    fn in_state(state) = " ({state})" | " ({state})";
    fn states(count) = "{count} states" | "{count} Stellungen";
    fn from_folder(folder) = "from {folder}" | "aus {folder}";
    fn only_read(folder) = "from {folder}, read-only" | "aus {folder}, schreibgeschützt";
    fn tau_tip(normal, uniform) = "τ at normal incidence {normal}, under uniform light {uniform}" | "τ bei senkrechtem Einfall {normal}, bei gleichförmigem Licht {uniform}";
    fn states_tip(count, state) = "{count} states; the picture shows the one{state}" | "{count} Stellungen; das Bild zeigt die{state}";
    const PICTURE_TIP = "Where direct sunlight from 40° altitude goes, seen from inside with up at the top; three decades below its own maximum" | "Wohin direktes Sonnenlicht aus 40° Höhe geht, von innen gesehen, oben ist oben; drei Dekaden unter dem eigenen Höchstwert";
    fn from_like(name, distance) = "From {name}: {distance}" | "Von {name}: {distance}";
    fn take_star(name) = "Remove the star of {name}" | "Stern entfernen: {name}";
    fn set_star(name) = "Star {name}" | "Stern setzen: {name}";
    const REMOVE_FROM_COMPARISON = "Remove from the comparison" | "Aus dem Vergleich entfernen";
    const REMOVE_FROM_COMPARISON_TIP = "Removes the product from the comparison" | "Entfernt das Produkt aus dem Vergleich";
    const COMPARE = "Compare" | "Vergleichen";
    const COMPARE_TIP = "Adds the product to the comparison" | "Fügt das Produkt dem Vergleich hinzu";
    fn about(what, name) = "{what}: {name}" | "{what}: {name}";
    const LIKE_THIS = "Similar products" | "Ähnliche Produkte";
    const LIKE_THIS_TIP = "Lists products by their effect on light, most similar first" | "Listet Produkte nach ihrer Wirkung auf das Licht, die ähnlichsten zuerst";
    const RENAME = "Rename…" | "Umbenennen…";
    const RENAME_TIP = "Edits name, manufacturer, kind and tags" | "Ändert Name, Hersteller, Art und Schlagwörter";
    const DELETE = "Delete" | "Löschen";
    const DELETE_TIP = "Hides the product; undo or Recently deleted restores it" | "Blendet das Produkt aus; Rückgängig oder „Zuletzt gelöscht“ stellt es wieder her";

    // Facets.
    const NOT_SPECIFIED = "not specified" | "keine Angabe";
    fn filter_by(title) = "Filter by {title}" | "Filter: {title}";
    const NONE_SPECIFIED = "No product specifies it" | "Kein Produkt gibt es an";
    const STARRED_ALONE = "Starred products only" | "Nur Produkte mit Stern";
    const RECENT = "Recent" | "Zuletzt benutzt";
    const RECENT_ALONE = "Recently shown products only, newest first" | "Nur zuletzt gezeigte Produkte, das neueste zuerst";
    const KIND = "Kind" | "Art";
    const MAKER = "Manufacturer" | "Hersteller";
    const MOVES = "Movable" | "Beweglich";
    const DATA = "Data" | "Daten";
    const FIGURES = "Figures" | "Kennwerte";
    const TAGS = "Tags" | "Schlagwörter";
    const COLLECTIONS = "Collections" | "Sammlungen";
    const KIND_FACET = "kind" | "Art";
    const MAKER_FACET = "manufacturer" | "Hersteller";
    const MOVES_FACET = "movable" | "Beweglichkeit";
    const DATA_FACET = "data" | "Daten";
    const FIGURES_FACET = "figures" | "Kennwerte";
    const TAGS_FACET = "tags" | "Schlagwörter";
    const COLLECTIONS_FACET = "collections" | "Sammlungen";
    const MOVING = "movable" | "beweglich";
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
    fn takes_out(words) = "{words}: a click removes this filter" | "{words}: ein Klick entfernt diesen Filter";
    fn without(words) = "Without {words}" | "Ohne {words}";
    const CLEAR = "Clear" | "Alle aufheben";
    const CLEAR_ALL = "Removes all filters" | "Entfernt alle Filter";
    fn count_of(found, total) = "{found} of {total}" | "{found} von {total}";
    fn products_fit(found, total) = "{found} of {total} products match" | "{found} von {total} Produkten passen";
    const FALLING = "Descending" | "Absteigend";
    const RISING = "Ascending" | "Aufsteigend";
    fn turn_round(order) = "{order}; a click reverses it" | "{order}; ein Klick kehrt um";
    const ORDER_TIP = "Order of the list" | "Reihenfolge der Liste";
    const ORDER = "Order" | "Reihenfolge";
    fn read_as(typed, read_as) = "No product has “{typed}”: read as “{read_as}”" | "Kein Produkt enthält „{typed}“: gelesen als „{read_as}“";
    fn like(name) = "Similar to {name} ×" | "Ähnlich {name} ×";
    fn like_tip(name) = "Products by their effect on light, most similar to {name} first: differences of τ, its profile, light to the ceiling, sun blocked and view, all as shares of the incident light. A click returns to the list" | "Produkte nach ihrer Wirkung auf das Licht, {name} am ähnlichsten zuerst: Unterschiede von τ, Profil, Licht zur Decke, abgehaltener Sonne und Durchsicht, alle als Anteile des auftreffenden Lichts. Ein Klick führt zurück zur Liste";
    fn no_longer_like(name) = "No longer similar to {name}" | "Nicht mehr ähnlich {name}";
    const NO_PRODUCT_YET = "The catalogue is empty: open a file to import a product." | "Der Katalog ist leer: eine Datei öffnen, um ein Produkt zu importieren.";
    const NOT_ALL_WORDS = "No product contains all these words." | "Kein Produkt enthält alle diese Wörter.";
    const NOT_WORDS_AND_FILTERS = "No product contains all these words and matches the filters." | "Kein Produkt enthält alle diese Wörter und passt zu den Filtern.";
    const NOT_ALL_FILTERS = "No product matches all the filters." | "Kein Produkt passt zu allen Filtern.";
    fn one_without(what) = "1 product without “{what}”" | "1 Produkt ohne „{what}“";
    fn more_without(count, what) = "{count} products without “{what}”" | "{count} Produkte ohne „{what}“";
    const SHOW_ALL = "Show all" | "Alle zeigen";

    // Damages.
    fn restored(keys) = "Damaged in the catalogue, and restored from the data built into the program: {keys}. The disk may be failing: keep a copy, and run `cfs catalogue check`." | "Im Katalog beschädigt und aus dem Bestand des Programms wiederhergestellt: {keys}. Der Datenträger ist möglicherweise fehlerhaft: eine Kopie aufbewahren und `cfs catalogue check` ausführen.";
    fn not_listed(keys) = "Not listed, because damaged in the catalogue: {keys}. `cfs catalogue check --repair` restores what can be restored; import the rest again." | "Nicht aufgeführt, da im Katalog beschädigt: {keys}. `cfs catalogue check --repair` stellt wieder her, was sich wiederherstellen lässt; den Rest erneut importieren.";

    // Figures and orders.
    const TAU_NORMAL = "τ normal" | "τ senkrecht";
    const TAU_HEMISPHERICAL = "τ hemispherical" | "τ hemisphärisch";
    const TO_CEILING = "Light to the ceiling" | "Licht zur Decke";
    const SUN_BLOCKED = "Sun blocked at 45°" | "Sonne abgehalten bei 45°";
    const VIEW = "View" | "Durchsicht";
    const BEST_MATCH = "Best match" | "Beste Treffer";
    const NAME = "Name" | "Name";
    const STATES = "States" | "Stellungen";
    fn distance_is(distance, parts) = "{distance} apart: {parts}" | "Abstand {distance}: {parts}";
    fn no_difference(least) = "no difference above {least}" | "kein Unterschied über {least}";
    const DISTANCE_TAU = "τ" | "τ";
    const DISTANCE_PROFILE = "profile" | "Profil";
    const DISTANCE_CEILING = "ceiling" | "Decke";
    const DISTANCE_SUN = "sun blocked" | "abgehaltene Sonne";
    const DISTANCE_VIEW = "view" | "Durchsicht";

    // Collections, recent products, subscriptions.
    const COLLECTIONS_MENU = "Collections…" | "Sammlungen…";
    const COLLECTIONS_TIP = "Edits named sets of products and adds or removes the selected product" | "Bearbeitet benannte Gruppen von Produkten und fügt das gewählte Produkt hinzu oder entfernt es";
    const GALLERY_MENU = "Products as a gallery or a list" | "Produkte als Galerie oder Liste";
    const RECENT_MENU = "Recent products only, or all" | "Nur zuletzt benutzte Produkte oder alle";
    const STAR_MENU = "Star the product, or remove its star" | "Stern des Produkts setzen oder entfernen";
    const STAR_MENU_TIP = "Starred products can be shown on their own" | "Produkte mit Stern lassen sich allein zeigen";
    const FIRST_MENU = "Select the first product of the list" | "Erstes Produkt der Liste wählen";
    const FIRST_MENU_TIP = "Moves the keyboard focus to it; arrow keys continue from there" | "Setzt den Tastaturfokus darauf; die Pfeiltasten gehen von dort weiter";
    const SUBSCRIBE_MENU = "Subscribe to a folder…" | "Ordner abonnieren…";
    const SUBSCRIBE_TIP = "Lists the products of the packages in a shared folder, and reads them again when they change" | "Führt die Produkte der Pakete eines gemeinsamen Ordners auf und liest sie bei Änderungen neu";
    const SUBSCRIPTIONS = "Subscribed folders" | "Abonnierte Ordner";
    const SUBSCRIPTIONS_MENU = "Subscribed folders…" | "Abonnierte Ordner…";
    const SUBSCRIPTIONS_TIP = "Lists subscribed folders and ends subscriptions" | "Listet abonnierte Ordner und beendet Abonnements";
    const SUBSCRIBE = "Subscribe" | "Abonnieren";
    const SUBSCRIBE_TITLE = "Subscribe to a folder" | "Ordner abonnieren";
    const SUBSCRIBE_HINT = "A folder of packages (.cfsp), e.g. on a file share: its products are listed with the others, read-only." | "Ordner mit Paketen (.cfsp), z. B. auf einem Netzlaufwerk: seine Produkte stehen schreibgeschützt in der Liste.";
    const UNSUBSCRIBE = "Unsubscribe" | "Abonnement beenden";
    const UNSUBSCRIBE_TIP = "Removes its products from the list; Ctrl+Z restores them" | "Entfernt seine Produkte aus der Liste; Strg+Z stellt sie wieder her";
    const NO_SUBSCRIPTION = "No folder is subscribed to." | "Kein Ordner ist abonniert.";
    fn products_from(count) = "Products: {count}" | "Produkte: {count}";
    fn unsubscribed(folder) = "No longer subscribed: {folder}. Ctrl+Z restores its products" | "Nicht mehr abonniert: {folder}. Strg+Z stellt seine Produkte wieder her";
    fn subscribed_now(folder) = "Subscribed: {folder}. Ctrl+Z ends the subscription" | "Abonniert: {folder}. Strg+Z beendet das Abonnement";
    fn subscribed_already(folder) = "Already subscribed: {folder}. It is read again" | "Bereits abonniert: {folder}. Der Ordner wird neu gelesen";
    const NEW_COLLECTION = "New collection" | "Neue Sammlung";
    const ADD = "Add" | "Hinzufügen";
    const ADD_TIP = "Creates a collection with this product" | "Legt eine Sammlung mit diesem Produkt an";
    fn members(name, count) = "{name}  {count}" | "{name}  {count}";
    const NO_COLLECTION = "No collection yet: enter a name to create one with the product above." | "Noch keine Sammlung: einen Namen eingeben, um eine mit dem Produkt oben anzulegen.";
    const COLLECTIONS_HELP = "Ticked: this product is in the collection. The filter of the same name lists the products of a collection." | "Mit Haken: Das Produkt gehört zur Sammlung. Der gleichnamige Filter zeigt die Produkte einer Sammlung.";
    const DISBAND = "Delete" | "Löschen";
    const DISBAND_TIP = "Deletes the collection; its products stay in the catalogue, and Ctrl+Z restores it" | "Löscht die Sammlung; ihre Produkte bleiben im Katalog, und Strg+Z stellt sie wieder her";
    const SHOW = "Show" | "Zeigen";
    const SHOW_TIP = "Lists only the products of this collection" | "Listet nur die Produkte dieser Sammlung";

    // A product's sheet.
    const MANUFACTURER = "Manufacturer" | "Hersteller";
    const AUTHOR = "Author" | "Verfasser";
    const LICENSE = "Licence" | "Lizenz";
    const LICENSE_HINT = "e.g. CC BY 4.0" | "z. B. CC BY 4.0";
    const NONE_SELECTED = "No product selected: select one in the catalogue." | "Kein Produkt gewählt: im Katalog eines wählen.";
    fn key_in_scenes(key) = "Key in scenes: {key}" | "Schlüssel in Szenen: {key}";
    fn of_subscription(folder) = "From the subscribed folder {folder}, read-only." | "Aus dem abonnierten Ordner {folder}, schreibgeschützt.";
    const OF_PROGRAM = "Built in: name, kind and tags are fixed. Deleting hides it." | "Mitgeliefert: Name, Art und Schlagwörter sind fest. Löschen blendet es aus.";
    const SAVE = "Save" | "Speichern";
    const DELETE_PRODUCT = "Delete product" | "Produkt löschen";
    const DELETE_PRODUCT_TIP = "Hides the product; it can be restored" | "Blendet das Produkt aus; es lässt sich wiederherstellen";
    const KEY = "Key" | "Schlüssel";
    const ANGLE_DEGREES = "Angle [°]" | "Winkel [°]";
    const ANGLE = "Angle" | "Winkel";
    const SINGLE_STATE = "single state" | "einzige Stellung";
    fn of_state(what, state) = "{what} of state {state}" | "{what} der Stellung {state}";
    const REPLACE = "Replace…" | "Ersetzen…";
    const REPLACE_TIP = "Reads other data for this state from a file" | "Liest andere Daten für diese Stellung aus einer Datei";
    fn replace_state(state) = "Replace state {state}" | "Stellung {state} ersetzen";
    const FILES = "Files" | "Dateien";
    const READ_AGAIN = "Read its files again" | "Dateien neu lesen";
    const READ_AGAIN_TIP = "Reads its files and shows changes before they are applied" | "Liest die Dateien und zeigt Änderungen, bevor sie übernommen werden";
    const NOTHING_CHANGED = "The files have not changed since they were read." | "Die Dateien haben sich seit dem Lesen nicht geändert.";
    const TAKE_CHANGES = "Apply the changes" | "Änderungen übernehmen";
    const TAKE_CHANGES_TIP = "Replaces the data; Ctrl+Z restores the previous ones" | "Ersetzt die Daten; Strg+Z stellt die vorigen wieder her";
    const HISTORY = "History" | "Verlauf";
    const NO_HISTORY = "No entries." | "Keine Einträge.";
    const DELETED_HELP = "Hidden, but still stored. Scenes that name them still work." | "Ausgeblendet, aber weiter gespeichert. Szenen, die sie nennen, funktionieren weiter.";
    const NONE_DELETED = "No deleted products." | "Keine gelöschten Produkte.";
    fn at_built_in(at) = "{at}, built in" | "{at}, mitgeliefert";
    const RESTORE = "Restore" | "Wiederherstellen";
    fn restore(name) = "Restore {name}" | "{name} wiederherstellen";
    const NEEDS_A_NAME = "A name is missing." | "Ein Name fehlt.";
    fn no_angle(text) = "“{text}” is not an angle; expected a number of degrees." | "„{text}“ ist kein Winkel; erwartet wird eine Zahl in Grad.";

    // Messages after a change.
    const DELETED_ALREADY = "The product is already deleted; select another one" | "Das Produkt ist bereits gelöscht; ein anderes wählen";
    fn deleted(name) = "Deleted: {name}. Ctrl+Z, or Recently deleted in the Edit menu, restores it" | "Gelöscht: {name}. Strg+Z oder „Zuletzt gelöscht“ im Menü Bearbeiten stellt es wieder her";
    fn synced(taken, gone) = "Subscribed folders: {taken} products added or changed, {gone} removed" | "Abonnierte Ordner: {taken} Produkte neu oder geändert, {gone} entfernt";
    const REPLACED = "Data replaced; Ctrl+Z restores the previous data" | "Daten ersetzt; Strg+Z stellt die vorigen wieder her";
    const TAKEN = "Changes applied; Ctrl+Z restores the previous data" | "Änderungen übernommen; Strg+Z stellt die vorigen Daten wieder her";
    fn tau_becomes(file, before, after) = "{file}: τ changes from {before} to {after}" | "{file}: τ ändert sich von {before} auf {after}";
}
