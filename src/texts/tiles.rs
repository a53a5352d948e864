//! The tiles of the bench and what stands in them.

texts! {
    // Titles and help.
    const BTDF = "BTDF" | "BTDF";
    const BTDF_HELP = "Where light from one direction leaves, as luminance per illuminance (q in 1/sr). IEA SHC Task 31, eq 2." | "Wohin Licht aus einer Richtung austritt, als Leuchtdichte je Beleuchtungsstärke (q in 1/sr). IEA SHC Task 31, Gl. 2.";
    const TRANSMITTANCE = "Transmittance" | "Transmission";
    const TRANSMITTANCE_HELP = "The share of the light from each direction that enters the room. Task 31, eq 1." | "Der Anteil des Lichts aus jeder Richtung, der in den Raum gelangt. Task 31, Gl. 1.";
    const SKY = "Sky" | "Himmel";
    const SKY_HELP = "Luminance of sky, sun and ground as the façade sees them. CIE S 011 / ISO 15469." | "Leuchtdichte von Himmel, Sonne und Boden, wie die Fassade sie sieht. CIE S 011 / ISO 15469.";
    const LID = "LID" | "LVK";
    const LID_HELP = "The window as a luminaire: luminous intensity into the room. Task 31, eq 5." | "Das Fenster als Leuchte: Lichtstärke in den Raum. Task 31, Gl. 5.";
    const ROOM = "Room" | "Raum";
    const ROOM_HELP = "Illuminance on the sensor plane, direct and interreflected. Task 31, eq 17." | "Beleuchtungsstärke auf der Nutzebene, direkt und interreflektiert. Task 31, Gl. 17.";
    const CONTROL = "Control" | "Regelung";
    const CONTROL_HELP = "Which state control chooses against the sun's profile angle, today and over the year." | "Welche Stellung die Regelung zum Profilwinkel der Sonne wählt, heute und übers Jahr.";

    // BTDF.
    const BTDF_ABOUT = "For one direction of incidence (left), the luminance coefficient q = L/E in every direction in which light leaves (right). Both hemispheres are seen from inside: a source is drawn where it is seen, emergent light where it goes. θ is counted from the façade's normal, φ from the right seen from outside towards up. Click a cell or use the arrow keys. The data show as measured, filtered over the patch that a direction stands for, or compressed by wavelets.\nSource: IEA SHC Task 31 report (2005), eq 2 and 13; data as measured or computed for the product." | "Für eine Einfallsrichtung (links) der Leuchtdichtekoeffizient q = L/E in jeder Austrittsrichtung (rechts). Beide Halbräume sind von innen gesehen: eine Quelle steht, wo sie gesehen wird, austretendes Licht, wohin es geht. θ zählt von der Fassadennormalen, φ von rechts (von außen gesehen) nach oben. Eine Zelle anklicken oder Pfeiltasten. Die Daten erscheinen wie gemessen, gefiltert über das Feld, für das eine Richtung steht, oder durch Wavelets komprimiert.\nQuelle: Bericht IEA SHC Task 31 (2005), Gl. 2 und 13; Daten wie für das Produkt gemessen oder berechnet.";
    const BTDF_EMPTY = "Choose a product in the catalogue to see where its light goes." | "Ein Produkt im Katalog wählen, um zu sehen, wohin sein Licht geht.";
    const FOLLOW_THE_SUN = "Follow the sun" | "Sonne folgen";
    const DISK = "Disk" | "Scheibe";
    const DISK_TIP = "Where light goes, in false colours" | "Wohin Licht geht, in Falschfarben";
    const BODY = "3D" | "3D";
    const BODY_TIP = "The same as a body, its radius the value; drag to turn, wheel to zoom" | "Dasselbe als Körper, der Radius ist der Wert; Ziehen dreht, das Rad vergrößert";
    const CUTS = "Cuts" | "Schnitte";
    const CUTS_TIP = "Curves over the angle, in the plane of incidence and across it" | "Kurven über dem Winkel, in der Einfallsebene und quer dazu";
    const LOG = "log" | "log";
    const LOG_THREE = "Logarithmic colours, three decades" | "Logarithmische Farben, drei Dekaden";
    const LOG_COLOURS = "Logarithmic colours" | "Logarithmische Farben";
    const LOG_SECTION = "Logarithmic colours and section" | "Logarithmische Farben und logarithmischer Schnitt";
    const WEIGHTED_TIP = "Times the cosine: what intensity is made of" | "Mal Kosinus: woraus die Lichtstärke entsteht";
    const SHADE_TIP = "Grey by transmittance on the incident side" | "Grau nach Transmissionsgrad auf der Einfallsseite";
    const SOLID_TIP = "On: equal areas are equal solid angles (Lambert). Off: equal projected solid angles, r = sin θ" | "Ein: gleiche Flächen sind gleiche Raumwinkel (Lambert). Aus: gleiche projizierte Raumwinkel, r = sin θ";
    const HOLD = "Hold" | "Halten";
    const HOLD_TIP = "The scale stays as it is, whatever is shown" | "Die Skala bleibt, wie sie ist, was auch gezeigt wird";
    const WHERE_FROM = "where light comes from" | "woher Licht kommt";
    fn where_from_shaded(most) = "where light comes from\ngrey: τ 0–{most}" | "woher Licht kommt\nGrau: τ 0–{most}";
    const WHERE_TO = "where light goes" | "wohin Licht geht";
    const OUTSIDE = "outside" | "außen";
    const INSIDE = "inside" | "innen";
    fn side_and(side, what) = "{side}: {what}" | "{side}: {what}";
    fn side_over(side, what) = "{side}:\n{what}" | "{side}:\n{what}";
    const INCIDENT_HEMISPHERE = "Incident hemisphere" | "Einfallsseite";
    const EMERGENT_HEMISPHERE = "Emergent hemisphere" | "Austrittsseite";
    const NOTHING_SCATTERED = "nothing is scattered" | "nichts wird gestreut";
    fn regular_tau(tau) = "regular τ {tau}" | "gerichtet τ {tau}";
    const CUT_AXIS = "angle off the normal, straight on > 0" | "Winkel zur Normalen, geradeaus > 0";
    const CUT_IN = "in the plane of incidence" | "in der Einfallsebene";
    const CUT_ACROSS = "across it" | "quer dazu";
    const CUT_UPRIGHT = "upright plane" | "senkrechte Ebene";
    const CUT_LEVEL = "level plane" | "waagrechte Ebene";
    const EMERGENT_CUTS = "Emergent cuts" | "Schnitte des Austritts";
    fn largest_q(what, value) = "largest {what} {value} 1/sr" | "größtes {what} {value} 1/sr";
    fn largest(value) = "largest {value} 1/sr" | "größter Wert {value} 1/sr";
    const EMERGENT_BODY = "Emergent body" | "Körper des Austritts";
    fn incidence_tau(angles, tau) = "incidence {angles} · τ {tau}" | "Einfall {angles} · τ {tau}";
    fn scattered_regular(scattered, regular) = " (scattered {scattered}, regular {regular})" | " (gestreut {scattered}, gerichtet {regular})";
    fn data_of(angles) = " · data of {angles}" | " · Daten von {angles}";
    fn leaving(theta, phi, what, value) = "leaving {theta} off the normal, φ {phi} · {what} {value} 1/sr" | "Austritt {theta} zur Normalen, φ {phi} · {what} {value} 1/sr";
    fn leaving_short(theta, phi, what, value) = "{theta} off normal, φ {phi} · {what} {value} 1/sr" | "{theta} zur Normalen, φ {phi} · {what} {value} 1/sr";

    const UP = "up" | "oben";
    const LEFT = "left" | "links";
    const RIGHT = "right" | "rechts";
    const DOWN = "down" | "unten";
    const INTO_THE_ROOM = "into the room" | "in den Raum";

    // Forms of the data.
    const MEASURED = "As measured" | "Wie gemessen";
    const MEASURED_TIP = "The data as they are" | "Die Daten, wie sie sind";
    const FILTERED = "Filtered" | "Gefiltert";
    const FILTERED_TIP = "Spread over the patch of the sky that the direction stands for, as diffuse light may be computed" | "Über das Himmelsfeld verteilt, für das die Richtung steht, wie diffuses Licht berechnet werden kann";
    const COMPACT = "Compact" | "Komprimiert";
    const COMPACT_TIP = "Compressed by wavelets, as the catalogue keeps large datasets" | "Durch Wavelets komprimiert, wie der Katalog große Datensätze aufbewahrt";
    fn data_offer(form) = "BTDF data: {form}" | "BTDF-Daten: {form}";
    const FORM_TIP = "In which form the data are shown" | "In welcher Form die Daten gezeigt werden";
    const FORM_COMING = "computing…" | "wird berechnet…";
    fn foot_filtered(scheme, in_force, largest, moved) = "{scheme} ({in_force}) · differs by up to {largest} 1/sr · {moved} % of the flux moved" | "{scheme} ({in_force}) · Abweichung bis {largest} 1/sr · {moved} % des Lichtstroms verschoben";
    fn foot_filtered_short(largest, moved) = "filtered · up to {largest} 1/sr · {moved} % moved" | "gefiltert · bis {largest} 1/sr · {moved} % verschoben";
    const FILTER_IN_FORCE = "as the scene asks" | "wie die Szene es verlangt";
    const FILTER_NOT_IN_FORCE = "the scene uses finer sub-patches instead" | "die Szene rechnet mit feineren Teilfeldern";
    fn foot_compact(kept, cells, largest, moved, allowed) = "compact: {kept} of {cells} numbers · differs by up to {largest} 1/sr · {moved} % of the flux misplaced, {allowed} % allowed · the catalogue keeps these data without loss" | "komprimiert: {kept} von {cells} Zahlen · Abweichung bis {largest} 1/sr · {moved} % des Lichtstroms verlagert, {allowed} % erlaubt · der Katalog bewahrt diese Daten verlustfrei";
    fn foot_compact_middle(kept, cells, largest, moved, allowed) = "compact: {kept} of {cells} numbers · up to {largest} 1/sr · {moved} % misplaced ({allowed} % allowed)" | "komprimiert: {kept} von {cells} Zahlen · bis {largest} 1/sr · {moved} % verlagert ({allowed} % erlaubt)";
    fn foot_compact_short(kept, cells) = "compact: {kept} of {cells} numbers" | "komprimiert: {kept} von {cells} Zahlen";
    fn foot_kept_compact(kept, cells, allowed) = "compact: {kept} of {cells} numbers · {allowed} % of the flux may be misplaced · the catalogue keeps these data so" | "komprimiert: {kept} von {cells} Zahlen · {allowed} % des Lichtstroms dürfen verlagert sein · so bewahrt der Katalog diese Daten";
    const NO_FORM_VALUES = "No values to filter or compress: these data are a closed form." | "Keine Werte zum Filtern oder Komprimieren: die Daten sind eine geschlossene Form.";
    const NO_FORM_MEANS = "Not filtered: these data are means over incident cells already." | "Nicht gefiltert: die Daten sind bereits Mittel über Einfallszellen.";
    const NO_FORM_LATTICE = "Not filtered: the incident directions are no lattice of patches." | "Nicht gefiltert: die Einfallsrichtungen sind kein Raster von Feldern.";
    fn no_form_values(why) = "Not compressed: {why}." | "Nicht komprimiert: {why}.";

    // The map of schemes.
    const SCHEMES = "Schemes" | "Schemata";
    const SCHEMES_TIP = "How light is interpolated between the directions of the data, triangle by triangle" | "Wie zwischen den Richtungen der Daten interpoliert wird, Dreieck für Dreieck";
    const SCHEMES_OFFER = "BTDF: map of interpolation schemes" | "BTDF: Karte der Interpolationsschemata";
    const SCHEME_MAP = "Scheme map" | "Karte der Schemata";
    const WAY_MOVED = "lobes moved" | "Keulen bewegt";
    const WAY_FADED = "moved, some faded" | "bewegt, teils geblendet";
    const WAY_BLENDED = "bases blended" | "Grundanteile gemischt";
    const WAY_DARK = "dark" | "dunkel";
    fn why_moved(share, travel) = "Lobes moved: all of them, with {share} % of the flux, are found at all three corners, up to {travel} apart" | "Keulen bewegt: alle, mit {share} % des Lichtstroms, finden sich an allen drei Ecken, bis {travel} auseinander";
    fn why_faded(missing, share) = "Some faded: {missing} % of the flux in lobes is missing at a corner; lobes carry {share} % of all" | "Teils geblendet: {missing} % des Lichtstroms in Keulen fehlen an einer Ecke; Keulen tragen {share} % von allem";
    const WHY_BLENDED = "Bases blended: no corner has a lobe" | "Grundanteile gemischt: keine Ecke hat eine Keule";
    const WHY_DARK = "Dark: nothing gets through at the corners" | "Dunkel: an den Ecken gelangt nichts hindurch";
    fn why_asked(scheme) = "“{scheme}”, as the scene asks" | "„{scheme}“, wie die Szene es verlangt";
    fn stated(own, rest) = "misplaces about {own} % here ({rest})" | "verlagert hier etwa {own} % ({rest})";
    const NO_SCHEMES_DIRECTIONS = "No map of schemes: these data are means over cells, taken at their word." | "Keine Karte: die Daten sind Mittel über Zellen und gelten, wie sie sind.";
    const NO_SCHEMES_PATCHES = "No map of schemes: the scene takes every direction for its patch." | "Keine Karte: die Szene nimmt jede Richtung für ihr Feld.";
    const NO_SCHEMES_TRIANGLES = "No map of schemes: the directions have no triangles between them." | "Keine Karte: zwischen den Richtungen liegen keine Dreiecke.";
    const SCHEMES_COMING = "Leaving out each direction in turn…" | "Jede Richtung wird einmal ausgelassen…";
}
