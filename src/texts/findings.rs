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
        "Results need transmission and reflection alone." | "Ergebnisse brauchen nur Transmission und Reflexion.";
    "back-placeholder": "Back data are a placeholder" | "Platzhalter statt Rückseitendaten",
        "Light from outside is not affected; the transmission from the room follows from it by reciprocity." | "Licht von außen ist nicht betroffen; die Transmission von der Raumseite folgt daraus durch Reziprozität.";
    "back-zero": "Back transmission is zero" | "Transmission von der Raumseite ist null",
        "Light from outside is not affected; the transmission from the room follows from it by reciprocity." | "Licht von außen ist nicht betroffen; die Transmission von der Raumseite folgt daraus durch Reziprozität.";
    "band-copied": "Solar and visible data are the same" | "Solare und sichtbare Daten sind gleich",
        "Solar gains computed from these data would be those of light, or light those of the solar band." | "Solare Gewinne aus diesen Daten wären die des Lichts, oder das Licht das des solaren Bands.";
    "band-not-read": "Spectral band not read" | "Spektralband nicht gelesen",
        "Daylight needs the visible band alone." | "Tageslicht braucht nur das sichtbare Band.";
    "basis-list-differs": "Angle basis differs from its name" | "Winkelraster weicht von seinem Namen ab",
        "The listed patches are used, whatever their name promises." | "Die aufgeführten Felder gelten, was immer der Name verspricht.";
    "beams-not-restored": "Sharp beams not restored" | "Scharfe Bündel nicht wiederhergestellt",
        "The direct sun is blurred to the size of the patches." | "Direktes Sonnenlicht ist auf die Größe der Felder verbreitert.";
    "block-mislabelled": "Block under a wrong name" | "Block unter falschem Namen",
        "The block is no reflection; used as one, interreflection in the room would be wrong." | "Der Block ist keine Reflexion; als solche verwendet, wäre die Interreflexion im Raum falsch.";
    "compact-storage": "Stored in compact form" | "Kompakt gespeichert",
        "Results differ by less than the criterion that is named." | "Ergebnisse weichen um weniger als das genannte Kriterium ab.";
    "computed": "Computed data" | "Berechnete Daten",
        "The values come from an optical model; their estimated error is named." | "Die Werte kommen aus einem optischen Modell; ihre geschätzte Unsicherheit ist genannt.";
    "copied-block": "The same data for both sides" | "Gleiche Daten für beide Seiten",
        "One side's function is taken for the other's; results for that side are those of another system." | "Die Daten einer Seite gelten für die andere; Ergebnisse für diese Seite sind die eines anderen Systems.";
    "cosine-factor": "Values with a cosine too many or too few" | "Werte mit einem Kosinus zu viel oder zu wenig",
        "Light at grazing angles is weighed wrongly: ceilings and walls are too dark or too bright, and τ is wrong." | "Streifendes Licht ist falsch gewichtet: Decken und Wände sind zu dunkel oder zu hell, und τ ist falsch.";
    "derived-left-out": "Derived function not written" | "Abgeleitete Funktion nicht geschrieben",
        "Whoever reads the file derives it again from the other side." | "Wer die Datei liest, leitet sie wieder aus der anderen Seite ab.";
    "derived-written": "Derived function written" | "Abgeleitete Funktion geschrieben",
        "The file does not show that it was derived and not measured." | "Die Datei zeigt nicht, dass sie abgeleitet und nicht gemessen ist.";
    "device-type-unknown": "Unknown device type" | "Unbekannter Gerätetyp",
        "Only the product's kind is open." | "Nur die Art des Produkts bleibt offen.";
    "encoding-repaired": "Text encoding repaired" | "Zeichenkodierung berichtigt",
        "Only names and notes are concerned." | "Betroffen sind nur Namen und Anmerkungen.";
    "energy-above-one": "More light leaves than arrives" | "Mehr Licht tritt aus als ein",
        "Results are too bright by as much as the sum exceeds 1, from those directions." | "Ergebnisse sind aus diesen Richtungen um so viel zu hell, wie die Summe über 1 liegt.";
    "error-target-missed": "Target uncertainty not reached" | "Angestrebte Unsicherheit nicht erreicht",
        "The data are less exact than asked for at some directions." | "Die Daten sind für manche Richtungen weniger genau als verlangt.";
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
        "The data are taken for single directions." | "Die Daten gelten als die einzelner Richtungen.";
    "incomplete-incidence": "Incident directions are missing" | "Einfallsrichtungen fehlen",
        "Values between distant directions are interpolated and less certain." | "Werte zwischen entfernten Richtungen sind interpoliert und weniger sicher.";
    "incomplete-matrix": "Almost all values are missing" | "Fast alle Werte fehlen",
        "Almost all directions are dark: only good for testing." | "Fast alle Richtungen sind dunkel: nur zum Testen geeignet.";
    "junk-before-xml": "Text before the XML" | "Text vor dem XML",
        "The data after it are read as they are." | "Die Daten dahinter sind unverändert gelesen.";
    "layers-not-read": "Layers not read" | "Schichten nicht gelesen",
        "Light passes the system as a whole, which the file describes by data of its own." | "Licht durchdringt das System als Ganzes, das die Datei mit eigenen Daten beschreibt.";
    "lossless-storage": "Stored without loss" | "Verlustfrei gespeichert",
        "Results are those of the file." | "Ergebnisse sind die der Datei.";
    "maybe-sides-swapped": "Outside and inside possibly swapped" | "Außen und innen möglicherweise vertauscht",
        "Light would meet the system from the wrong side: other transmittances, another reflectance towards the room." | "Licht träfe das System von der falschen Seite: andere Transmissionsgrade, anderer Reflexionsgrad zum Raum.";
    "maybe-upside-down": "Possibly upside down" | "Möglicherweise kopfüber",
        "Light that should reach the ceiling would fall on the floor by the window, or the reverse; sun protection would seem to fail." | "Licht für die Decke fiele auf den Boden am Fenster oder umgekehrt; der Sonnenschutz schiene zu versagen.";
    "means-as-directions": "Means over patches read as single directions" | "Mittel über Felder als einzelne Richtungen gelesen",
        "Fine structure within a patch is lost." | "Feine Strukturen innerhalb eines Felds gehen verloren.";
    "mirrored-block": "Left and right are mirrored" | "Links und rechts gespiegelt",
        "Morning and afternoon would be exchanged for this function." | "Vor- und Nachmittag wären für diese Funktion vertauscht.";
    "missing-block": "Function is missing" | "Funktion fehlt",
        "What depends on it is derived or assumed; daylight from outside needs the front transmission and the reflection of the room side." | "Was davon abhängt, ist abgeleitet oder angenommen; Tageslicht braucht die Transmission von außen und die Reflexion der Raumseite.";
    "missing-patches": "Dark patches among bright ones" | "Dunkle Felder zwischen hellen",
        "From those directions the room would be dark; whenever the sun stands there results are too low." | "Aus diesen Richtungen bliebe der Raum dunkel; steht die Sonne dort, sind Ergebnisse zu niedrig.";
    "negative-values": "Negative values" | "Negative Werte",
        "Negative luminances would be subtracted from the light of other directions." | "Negative Leuchtdichten würden vom Licht anderer Richtungen abgezogen.";
    "no-identity": "Name or manufacturer missing" | "Name oder Hersteller fehlt",
        "Nobody can tell later whose data these are; results are not affected." | "Später lässt sich nicht feststellen, wessen Daten es sind; Ergebnisse sind nicht betroffen.";
    "no-transmission": "No visible transmission" | "Keine sichtbare Transmission",
        "The system cannot light a room." | "Das System kann keinen Raum beleuchten.";
    "not-a-number": "Values that are not numbers" | "Werte sind keine Zahlen",
        "No result could be computed." | "Kein Ergebnis ließe sich berechnen.";
    "not-computed": "Data not computed" | "Daten nicht berechnet",
        "They are computed when a scene needs them." | "Sie werden berechnet, sobald eine Szene sie braucht.";
    "not-rotational": "Not rotationally symmetric" | "Nicht rotationssymmetrisch",
        "A tree of three angles would average over the azimuth." | "Ein Baum über drei Winkel würde über das Azimut mitteln.";
    "one-function": "One function for all" | "Eine Funktion für alles",
        "The file holds one function; the others are derived or missing." | "Die Datei enthält eine Funktion; die anderen sind abgeleitet oder fehlen.";
    "opaque": "Opaque" | "Undurchlässig",
        "No light enters the room." | "Kein Licht gelangt in den Raum.";
    "orientation": "Light that leaves upwards and downwards" | "Licht nach oben und nach unten",
        "The one thing that numbers cannot show: compare it with the product." | "Das zeigen Zahlen nicht: mit dem Produkt vergleichen.";
    "percent": "Values in percent" | "Werte in Prozent",
        "Rooms would be lit 100 times too brightly." | "Räume würden 100-mal zu hell.";
    "points-gap": "Gap between measured directions" | "Lücke zwischen gemessenen Richtungen",
        "Light into the gap is not known from these data." | "Licht in die Lücke ist aus diesen Daten nicht bekannt.";
    "points-resampled": "Scattered points resampled" | "Messpunkte auf ein Raster umgerechnet",
        "Values between the points are interpolated." | "Werte zwischen den Punkten sind interpoliert.";
    "resampled": "Resampled" | "Umgerechnet",
        "Values are means over the patches of the written basis." | "Die Werte sind Mittel über die Felder des geschriebenen Rasters.";
    "reciprocity": "Reciprocity of the two sides" | "Reziprozität der beiden Seiten",
        "How far the two sides can be trusted together; only the function of the side in use enters a result." | "Zeigt, wie gut beide Seiten zusammenpassen; in Ergebnisse geht nur die benutzte Seite ein.";
    "regular-in-cells": "Regular transmission within patches" | "Gerichtete Transmission in Feldern",
        "The unscattered beam is blurred to the size of the patches." | "Das ungestreute Bündel ist auf die Größe der Felder verbreitert.";
    "resolution": "Resolution of the data" | "Auflösung der Daten",
        "Effects finer than the patches are averaged away." | "Feinere Wirkungen als die Felder sind weggemittelt.";
    "several-layers": "More than one layer" | "Mehr als eine Schicht",
        "The other layers are missing from every result." | "Die anderen Schichten fehlen in jedem Ergebnis.";
    "side-not-told": "Side not specified" | "Seite nicht angegeben",
        "As good as the back transmission that it is derived from." | "So gut wie die Transmission von der Raumseite, aus der sie abgeleitet ist.";
    "sides": "Transmittance and reflectance of both sides" | "Transmissions- und Reflexionsgrade beider Seiten",
        "The one thing that numbers cannot show: compare it with the product." | "Das zeigen Zahlen nicht: mit dem Produkt vergleichen.";
    "sides-swapped": "Outside and inside swapped" | "Außen und innen vertauscht",
        "Light would meet the system from the wrong side: other transmittances, another reflectance towards the room." | "Licht träfe das System von der falschen Seite: andere Transmissionsgrade, anderer Reflexionsgrad zum Raum.";
    "solar-not-written": "Solar band not written" | "Solares Band nicht geschrieben",
        "The format holds light alone; solar gains need the original." | "Das Format enthält nur Licht; solare Gewinne brauchen das Original.";
    "solar-partly-visible": "Solar data partly taken from visible ones" | "Solare Daten teils aus sichtbaren",
        "Solar gains are those of light where a material has no solar properties." | "Solare Gewinne sind die des Lichts, wo ein Material keine solaren Eigenschaften hat.";
    "sparse-incidence": "Few incident directions" | "Wenige Einfallsrichtungen",
        "Values between distant directions are interpolated and less certain." | "Werte zwischen entfernten Richtungen sind interpoliert und weniger sicher.";
    "state-not-written": "State not written" | "Stellung nicht geschrieben",
        "The format has no place for it; the written file does not name it." | "Das Format hat keinen Platz dafür; die Datei nennt sie nicht.";
    "symmetry": "Symmetry of the data" | "Symmetrie der Daten",
        "Where the system must look the same and where it must not." | "Zeigt, wo das System gleich aussehen muss und wo nicht.";
    "symmetry-broken": "Values contradict the symmetry" | "Werte widersprechen der Symmetrie",
        "The values are used as given; check which of both is right." | "Die Werte sind unverändert verwendet; prüfen, was stimmt.";
    "symmetry-declared": "Declared symmetry contradicts the system" | "Angegebene Symmetrie passt nicht zum System",
        "Suns from different sides at the same angle would give the same light, which is wrong for such a system." | "Sonnen von verschiedenen Seiten gäben bei gleichem Winkel dasselbe Licht, was für ein solches System falsch ist.";
    "symmetry-filled": "Completed by symmetry" | "Durch Symmetrie ergänzt",
        "Directions that the file leaves out are mirrored from others." | "Richtungen, die der Datei fehlen, sind aus anderen gespiegelt.";
    "template-word": "Placeholder of a template" | "Platzhalter einer Vorlage",
        "Nobody can tell later whose data these are; results are not affected." | "Später lässt sich nicht feststellen, wessen Daten es sind; Ergebnisse sind nicht betroffen.";
    "thermal-not-written": "Thermal data not written" | "Thermische Daten nicht geschrieben",
        "Light is not affected." | "Licht ist nicht betroffen.";
    "thermal-unreadable": "Thermal data unreadable" | "Thermische Daten unlesbar",
        "Light is not affected." | "Licht ist nicht betroffen.";
    "thickness-implausible": "Implausible thickness" | "Unplausible Dicke",
        "Only the section drawing needs the thickness." | "Nur die Schnittzeichnung braucht die Dicke.";
    "thickness-unreadable": "Thickness unreadable" | "Dicke unlesbar",
        "Only the section drawing needs the thickness." | "Nur die Schnittzeichnung braucht die Dicke.";
    "transposed-block": "Incident and emergent directions exchanged" | "Einfall und Austritt vertauscht",
        "Transmittance is read from the wrong directions: amounts, their change over the day and the light's way are wrong." | "Transmissionsgrade gelten für falsche Richtungen: Menge, Tagesgang und Weg des Lichts sind falsch.";
    "tree-kept": "Tensor tree kept" | "Tensorbaum beibehalten",
        "The file has the resolution of the data." | "Die Datei hat die Auflösung der Daten.";
    "tree-made": "Tensor tree computed" | "Tensorbaum berechnet",
        "The tree differs from the data by what is named." | "Der Baum weicht um das Genannte von den Daten ab.";
    "unknown-basis-name": "Unknown angle basis" | "Unbekanntes Winkelraster",
        "The listed patches are used." | "Die aufgeführten Felder gelten.";
    "unreadable": "Stored data cannot be read" | "Gespeicherte Daten sind unlesbar",
        "The state cannot be used; import it again or restore a backup." | "Die Stellung ist nicht verwendbar; erneut importieren oder Sicherung zurückholen.";
    "upside-down-block": "Upside down" | "Kopfüber",
        "Light that should reach the ceiling would fall on the floor by the window, or the reverse; sun protection would seem to fail." | "Licht für die Decke fiele auf den Boden am Fenster oder umgekehrt; der Sonnenschutz schiene zu versagen.";
    "window-solar": "Solar band for WINDOW" | "Solares Band für WINDOW",
        "Only solar gains in WINDOW are concerned." | "Betroffen sind nur solare Gewinne in WINDOW.";
    "window-defaults": "Default values of WINDOW" | "Vorgabewerte von WINDOW",
        "Only thermal values are concerned." | "Betroffen sind nur thermische Werte.";
    "zero-block": "Reflection is zero" | "Reflexion ist null",
        "The side counts as black: interreflection between it and the room is lost." | "Die Seite gilt als schwarz: Interreflexion zwischen ihr und dem Raum geht verloren.";
}
