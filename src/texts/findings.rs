//! Findings about datasets by their code: a title and what they mean for results.
//!
//! The sentence of a finding, with its place and numbers, comes from the reader or check that reports it and is English
//! in every language.

use super::Text;

/// Words about the findings of one code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FindingWords {
    /// Title without numbers.
    pub title: Text,
    /// Effect on results, one sentence; empty where the title says all.
    pub meaning: Text,
}

/// Returns the words for the findings of `code`; `None` for a code that no reader or check of datasets gives.
pub fn words(code: &str) -> Option<FindingWords> {
    WORDS.iter().find(|(known, _)| *known == code).map(|(_, words)| *words)
}

/// Returns what findings of `code` mean for results, in the current language; empty where their title says all.
pub fn meaning(code: &str) -> &'static str {
    words(code).map_or("", |words| words.meaning.get())
}

macro_rules! findings {
    ($($code:literal: $title:literal | $titel:literal, $meaning:literal | $bedeutung:literal;)*) => {
        /// Words by code.
        pub const WORDS: &[(&str, FindingWords)] = &[$((
            $code,
            FindingWords { title: Text::new($title, $titel), meaning: Text::new($meaning, $bedeutung) },
        )),*];

        /// Every text of this file in English and in German.
        pub(super) const PAIRS: &[(&str, &str)] = &[$(($title, $titel), ($meaning, $bedeutung)),*];
    };
}

findings! {
    "absorbed-not-read": "Absorptance not read" | "Absorptionsgrade nicht gelesen",
        "Results need only transmission and reflection." | "Ergebnisse brauchen nur Transmission und Reflexion.";
    "back-placeholder": "Back data are a placeholder" | "Platzhalter statt Rückseitendaten",
        "Light from outside is not affected; the transmission from the room follows from it by reciprocity." | "Licht von außen ist nicht betroffen; die Transmission von der Raumseite folgt daraus durch Reziprozität.";
    "back-zero": "Back transmission is zero" | "Transmission von der Raumseite ist null",
        "Light from outside is not affected; the transmission from the room follows from it by reciprocity." | "Licht von außen ist nicht betroffen; die Transmission von der Raumseite folgt daraus durch Reziprozität.";
    "band-copied": "Solar and visible data are the same" | "Solare und sichtbare Daten sind gleich",
        "Solar gains computed from these data would be those of light, or light those of the solar band." | "Solare Gewinne aus diesen Daten wären die des Lichts, oder das Licht das des solaren Bands.";
    "band-not-read": "Spectral band not read" | "Spektralband nicht gelesen",
        "Daylight needs only the visible band." | "Tageslicht braucht nur das sichtbare Band.";
    "basis-list-differs": "Angle basis differs from its name" | "Winkelraster weicht von seinem Namen ab",
        "The listed patches are used, not those of the name." | "Es gelten die aufgeführten Felder, nicht die des Namens.";
    "beams-not-restored": "Sharp beams not restored" | "Scharfe Bündel nicht wiederhergestellt",
        "Direct sun is blurred to the size of the patches." | "Direktes Sonnenlicht ist auf die Größe der Felder verbreitert.";
    "block-mislabelled": "Block under a wrong name" | "Block unter falschem Namen",
        "The block is not a reflection; used as one, it would make interreflection in the room wrong." | "Der Block ist keine Reflexion; als solche verwendet, wäre die Interreflexion im Raum falsch.";
    "compact-storage": "Stored in compact form" | "Kompakt gespeichert",
        "Results differ by less than the stated criterion." | "Ergebnisse weichen um weniger als das genannte Kriterium ab.";
    "computed": "Computed data" | "Berechnete Daten",
        "The values come from an optical model; their estimated uncertainty is stated." | "Die Werte kommen aus einem optischen Modell; ihre geschätzte Unsicherheit ist genannt.";
    "copied-block": "The same data for both sides" | "Gleiche Daten für beide Seiten",
        "The function of one side is used for the other; results for that side are those of another system." | "Die Daten einer Seite gelten für die andere; Ergebnisse für diese Seite sind die eines anderen Systems.";
    "cosine-factor": "Wrong cosine factor in the values" | "Falscher Kosinusfaktor in den Werten",
        "Light at grazing angles has the wrong weight: ceilings and walls are too dark or too bright, and τ is wrong." | "Streifendes Licht ist falsch gewichtet: Decken und Wände sind zu dunkel oder zu hell, und τ ist falsch.";
    "derived-left-out": "Derived function not written" | "Abgeleitete Funktion nicht geschrieben",
        "Programs that read the file derive it from the other side." | "Programme, die die Datei lesen, leiten sie aus der anderen Seite ab.";
    "derived-written": "Derived function written" | "Abgeleitete Funktion geschrieben",
        "The file does not show that it was derived and not measured." | "Die Datei zeigt nicht, dass sie abgeleitet und nicht gemessen ist.";
    "device-type-unknown": "Unknown device type" | "Unbekannter Gerätetyp",
        "Only the kind of the product is unknown." | "Nur die Art des Produkts ist unbekannt.";
    "encoding-repaired": "Text encoding repaired" | "Zeichenkodierung berichtigt",
        "Only names and notes are affected." | "Betroffen sind nur Namen und Anmerkungen.";
    "energy-above-one": "Transmittance plus reflectance above 1" | "Transmissions- plus Reflexionsgrad über 1",
        "Results for these directions are too bright by the excess above 1." | "Ergebnisse für diese Richtungen sind um den Überschuss über 1 zu hell.";
    "error-target-missed": "Target uncertainty not reached" | "Angestrebte Unsicherheit nicht erreicht",
        "The data are less exact than requested for some directions." | "Die Daten sind für manche Richtungen weniger genau als verlangt.";
    "front-by-reciprocity": "Front derived by reciprocity" | "Vorderseite durch Reziprozität abgeleitet",
        "As good as the back transmission that it is derived from." | "So gut wie die Transmission von der Raumseite, aus der sie abgeleitet ist.";
    "front-zero": "Front transmission is zero" | "Transmission von außen ist null",
        "No light enters the room." | "Kein Licht gelangt in den Raum.";
    "function-not-written": "Function not written" | "Funktion nicht geschrieben",
        "The format has no place for it; the written file holds less than the dataset." | "Das Format hat keinen Platz dafür; die Datei enthält weniger als der Datensatz.";
    "grazing-spike": "Spike at grazing incidence" | "Spitze bei streifendem Einfall",
        "A low or sideways sun would be transmitted too strongly." | "Tiefe oder seitliche Sonne würde zu stark durchgelassen.";
    "hash-differs": "Stored data are damaged" | "Gespeicherte Daten sind beschädigt",
        "The state cannot be used; import it again or restore a backup." | "Die Stellung ist nicht verwendbar; erneut importieren oder Sicherung zurückholen.";
    "incident-mean-not-told": "Averaging over incident directions not specified" | "Mittelung über Einfallsrichtungen nicht angegeben",
        "The data are used as those of single directions." | "Die Daten gelten als die einzelner Richtungen.";
    "incomplete-incidence": "Incident directions are missing" | "Einfallsrichtungen fehlen",
        "Values between distant directions are interpolated and less certain." | "Werte zwischen entfernten Richtungen sind interpoliert und weniger sicher.";
    "incomplete-matrix": "Almost all values are missing" | "Fast alle Werte fehlen",
        "Almost all directions are dark: suitable only for tests." | "Fast alle Richtungen sind dunkel: nur zum Testen geeignet.";
    "junk-before-xml": "Text before the XML" | "Text vor dem XML",
        "The data after it are read unchanged." | "Die Daten dahinter sind unverändert gelesen.";
    "layers-not-read": "Layers not read" | "Schichten nicht gelesen",
        "Light passes the system as a whole, which the file describes by data of its own." | "Licht durchdringt das System als Ganzes, das die Datei mit eigenen Daten beschreibt.";
    "lossless-storage": "Stored without loss" | "Verlustfrei gespeichert",
        "Results are those of the file." | "Ergebnisse sind die der Datei.";
    "maybe-sides-swapped": "Outside and inside possibly swapped" | "Außen und innen möglicherweise vertauscht",
        "Light would meet the system from the wrong side: other transmittances, another reflectance towards the room." | "Licht träfe das System von der falschen Seite: andere Transmissionsgrade, anderer Reflexionsgrad zum Raum.";
    "maybe-upside-down": "Possibly upside down" | "Möglicherweise kopfüber",
        "Light that should reach the ceiling would fall on the floor by the window, or the reverse; sun protection would seem to fail." | "Licht für die Decke fiele auf den Boden am Fenster oder umgekehrt; der Sonnenschutz schiene zu versagen.";
    "means-as-directions": "Means over patches read as single directions" | "Mittel über Felder als einzelne Richtungen gelesen",
        "Structure finer than a patch is lost." | "Feine Strukturen innerhalb eines Felds gehen verloren.";
    "mirrored-block": "Left and right are mirrored" | "Links und rechts gespiegelt",
        "Morning and afternoon would be exchanged for this function." | "Vor- und Nachmittag wären für diese Funktion vertauscht.";
    "missing-block": "Function is missing" | "Funktion fehlt",
        "What depends on it is derived or assumed; daylight from outside needs the front transmission and the reflection of the room side." | "Was davon abhängt, ist abgeleitet oder angenommen; Tageslicht braucht die Transmission von außen und die Reflexion der Raumseite.";
    "missing-patches": "Dark patches among bright ones" | "Dunkle Felder zwischen hellen",
        "From those directions the room would be dark; whenever the sun stands there results are too low." | "Aus diesen Richtungen bliebe der Raum dunkel; steht die Sonne dort, sind Ergebnisse zu niedrig.";
    "negative-values": "Negative values" | "Negative Werte",
        "Negative luminances would be subtracted from the light of other directions." | "Negative Leuchtdichten würden vom Licht anderer Richtungen abgezogen.";
    "no-identity": "Name or manufacturer missing" | "Name oder Hersteller fehlt",
        "The origin of the data cannot be identified later; results are not affected." | "Die Herkunft der Daten lässt sich später nicht feststellen; Ergebnisse sind nicht betroffen.";
    "no-transmission": "No visible transmission" | "Keine sichtbare Transmission",
        "The system cannot light a room." | "Das System kann keinen Raum beleuchten.";
    "not-a-number": "Values that are not numbers" | "Werte sind keine Zahlen",
        "No result could be computed." | "Kein Ergebnis ließe sich berechnen.";
    "not-computed": "Data not computed" | "Daten nicht berechnet",
        "They are computed when a scene needs them." | "Sie werden berechnet, sobald eine Szene sie braucht.";
    "not-rotational": "Not rotationally symmetric" | "Nicht rotationssymmetrisch",
        "A tree of three angles would average over the azimuth." | "Ein Baum über drei Winkel würde über das Azimut mitteln.";
    "one-function": "One function for all" | "Eine Funktion für alles",
        "The file contains one function; the others are derived or missing." | "Die Datei enthält eine Funktion; die anderen sind abgeleitet oder fehlen.";
    "opaque": "Opaque" | "Undurchlässig",
        "No light enters the room." | "Kein Licht gelangt in den Raum.";
    "orientation": "Shares of light upwards and downwards" | "Anteile des Lichts nach oben und nach unten",
        "Numbers cannot show this: compare with the product." | "Zahlen zeigen das nicht: mit dem Produkt vergleichen.";
    "percent": "Values in percent" | "Werte in Prozent",
        "Rooms would be lit 100 times too brightly." | "Räume würden 100-mal zu hell.";
    "points-gap": "Gap between measured directions" | "Lücke zwischen gemessenen Richtungen",
        "Light into the gap is not known from these data." | "Licht in die Lücke ist aus diesen Daten nicht bekannt.";
    "points-resampled": "Scattered points resampled" | "Gestreute Punkte auf ein Raster umgerechnet",
        "Values between the points are interpolated." | "Werte zwischen den Punkten sind interpoliert.";
    "resampled": "Resampled" | "Umgerechnet",
        "Values are means over the patches of the written basis." | "Die Werte sind Mittel über die Felder des geschriebenen Rasters.";
    "reciprocity": "Reciprocity of the two sides" | "Reziprozität der beiden Seiten",
        "Shows whether both sides agree; only the function of the side in use affects results." | "Zeigt, wie gut beide Seiten zusammenpassen; in Ergebnisse geht nur die benutzte Seite ein.";
    "regular-in-cells": "Regular transmission within patches" | "Gerichtete Transmission in Feldern",
        "Regular transmission is blurred to the size of the patches." | "Die gerichtete Transmission ist auf die Größe der Felder verbreitert.";
    "resolution": "Resolution of the data" | "Auflösung der Daten",
        "Effects finer than the patches are averaged away." | "Feinere Wirkungen als die Felder sind weggemittelt.";
    "several-layers": "More than one layer" | "Mehr als eine Schicht",
        "The other layers are missing from every result." | "Die anderen Schichten fehlen in jedem Ergebnis.";
    "side-not-told": "Side not specified" | "Seite nicht angegeben",
        "As good as the back transmission that it is derived from." | "So gut wie die Transmission von der Raumseite, aus der sie abgeleitet ist.";
    "sides": "Transmittance and reflectance of both sides" | "Transmissions- und Reflexionsgrade beider Seiten",
        "Numbers cannot show this: compare with the product." | "Zahlen zeigen das nicht: mit dem Produkt vergleichen.";
    "sides-swapped": "Outside and inside swapped" | "Außen und innen vertauscht",
        "Light would meet the system from the wrong side: other transmittances, another reflectance towards the room." | "Licht träfe das System von der falschen Seite: andere Transmissionsgrade, anderer Reflexionsgrad zum Raum.";
    "solar-not-written": "Solar band not written" | "Solares Band nicht geschrieben",
        "The format contains only visible data; solar gains need the original." | "Das Format enthält nur sichtbare Daten; solare Gewinne brauchen das Original.";
    "solar-partly-visible": "Solar data partly taken from visible ones" | "Solare Daten teils aus sichtbaren",
        "Where a material has no solar properties, its visible ones are used for solar gains." | "Wo ein Material keine solaren Eigenschaften hat, gelten für solare Gewinne die sichtbaren.";
    "sparse-incidence": "Few incident directions" | "Wenige Einfallsrichtungen",
        "Values between distant directions are interpolated and less certain." | "Werte zwischen entfernten Richtungen sind interpoliert und weniger sicher.";
    "state-not-written": "State not written" | "Stellung nicht geschrieben",
        "The format has no place for it; the written file does not name it." | "Das Format hat keinen Platz dafür; die Datei nennt sie nicht.";
    "symmetry": "Symmetry of the data" | "Symmetrie der Daten",
        "Shows for which rotations and reflections the data are the same." | "Zeigt, bei welchen Drehungen und Spiegelungen die Daten gleich sind.";
    "symmetry-broken": "Values contradict the symmetry" | "Werte widersprechen der Symmetrie",
        "The values are used as given; check which of both is right." | "Die Werte sind unverändert verwendet; prüfen, was stimmt.";
    "symmetry-declared": "Declared symmetry contradicts the system" | "Angegebene Symmetrie passt nicht zum System",
        "Sun from different sides at the same angle would give the same light, which is wrong for such a system." | "Sonnen von verschiedenen Seiten gäben bei gleichem Winkel dasselbe Licht, was für ein solches System falsch ist.";
    "symmetry-filled": "Completed by symmetry" | "Durch Symmetrie ergänzt",
        "Directions that the file leaves out are mirrored from others." | "Richtungen, die der Datei fehlen, sind aus anderen gespiegelt.";
    "template-word": "Placeholder of a template" | "Platzhalter einer Vorlage",
        "The origin of the data cannot be identified later; results are not affected." | "Die Herkunft der Daten lässt sich später nicht feststellen; Ergebnisse sind nicht betroffen.";
    "thermal-not-written": "Thermal data not written" | "Thermische Daten nicht geschrieben",
        "Light is not affected." | "Licht ist nicht betroffen.";
    "thermal-unreadable": "Thermal data unreadable" | "Thermische Daten unlesbar",
        "Light is not affected." | "Licht ist nicht betroffen.";
    "thickness-implausible": "Implausible thickness" | "Unplausible Dicke",
        "Only the section drawing needs the thickness." | "Nur die Schnittzeichnung braucht die Dicke.";
    "thickness-unreadable": "Thickness unreadable" | "Dicke unlesbar",
        "Only the section drawing needs the thickness." | "Nur die Schnittzeichnung braucht die Dicke.";
    "transposed-block": "Incident and emergent directions exchanged" | "Einfall und Austritt vertauscht",
        "Transmittances belong to wrong directions: amount, change over the day and distribution of light are wrong." | "Transmissionsgrade gelten für falsche Richtungen: Menge, Tagesgang und Verteilung des Lichts sind falsch.";
    "tree-kept": "Tensor tree kept" | "Tensorbaum beibehalten",
        "The file has the resolution of the data." | "Die Datei hat die Auflösung der Daten.";
    "tree-made": "Tensor tree computed" | "Tensorbaum berechnet",
        "The tree differs from the data by the stated amount." | "Der Baum weicht um den genannten Wert von den Daten ab.";
    "unknown-basis-name": "Unknown angle basis" | "Unbekanntes Winkelraster",
        "The listed patches are used." | "Die aufgeführten Felder gelten.";
    "unreadable": "Stored data cannot be read" | "Gespeicherte Daten sind unlesbar",
        "The state cannot be used; import it again or restore a backup." | "Die Stellung ist nicht verwendbar; erneut importieren oder Sicherung zurückholen.";
    "upside-down-block": "Upside down" | "Kopfüber",
        "Light that should reach the ceiling would fall on the floor by the window, or the reverse; sun protection would seem to fail." | "Licht für die Decke fiele auf den Boden am Fenster oder umgekehrt; der Sonnenschutz schiene zu versagen.";
    "window-solar": "Solar band for WINDOW" | "Solares Band für WINDOW",
        "Only solar gains in WINDOW are affected." | "Betroffen sind nur solare Gewinne in WINDOW.";
    "window-defaults": "Default values of WINDOW" | "Vorgabewerte von WINDOW",
        "Only thermal values are affected." | "Betroffen sind nur thermische Werte.";
    "zero-block": "Reflection is zero" | "Reflexion ist null",
        "The side is treated as black: interreflection with the room is lost." | "Die Seite gilt als schwarz: Interreflexion zwischen ihr und dem Raum geht verloren.";
}
