//! Texts for terms of the layers below in window, pictures and reports: moments, skies, rules, accuracy.

texts! {
    // Moments and places.
    const JANUARY = "Jan" | "Jan.";
    const FEBRUARY = "Feb" | "Feb.";
    const MARCH = "Mar" | "März";
    const APRIL = "Apr" | "Apr.";
    const MAY = "May" | "Mai";
    const JUNE = "Jun" | "Juni";
    const JULY = "Jul" | "Juli";
    const AUGUST = "Aug" | "Aug.";
    const SEPTEMBER = "Sep" | "Sept.";
    const OCTOBER = "Oct" | "Okt.";
    const NOVEMBER = "Nov" | "Nov.";
    const DECEMBER = "Dec" | "Dez.";
    fn moment(day, month, clock) = "{day} {month} {clock}" | "{day}. {month} {clock} Uhr";
    const ON_THE_HORIZON = "on the horizon" | "am Horizont";
    fn below_the_horizon(angle) = "{angle} below the horizon" | "{angle} unter dem Horizont";
    fn high(angle) = "{angle} high" | "{angle} hoch";
    const NORTH = "north" | "Nord";
    const NORTH_EAST = "north-east" | "Nordost";
    const EAST = "east" | "Ost";
    const SOUTH_EAST = "south-east" | "Südost";
    const SOUTH = "south" | "Süd";
    const SOUTH_WEST = "south-west" | "Südwest";
    const WEST = "west" | "West";
    const NORTH_WEST = "north-west" | "Nordwest";
    const NO_PLACE = "no place" | "kein Ort";
    const N = "N" | "N";
    const E = "E" | "O";
    const S = "S" | "S";
    const W = "W" | "W";
    fn coordinates(latitude, ns, longitude, ew) = "{latitude}°{ns} {longitude}°{ew}" | "{latitude}°{ns} {longitude}°{ew}";
    fn sun_by_angles(height, bearing) = "sun {height} at {bearing}°" | "Sonne {height} bei {bearing}°";
    const NO_SUN = "no sun" | "keine Sonne";

    // Skies.
    const OVERCAST = "overcast" | "bedeckt";
    const PARTLY_CLOUDY = "partly cloudy" | "teilweise bewölkt";
    const CLEAR = "clear" | "klar";
    fn cie_sky(word, number) = "{word} (CIE {number})" | "{word} (CIE {number})";
    const CIE_SKY = "CIE sky" | "CIE-Himmel";
    const UNIFORM_SKY = "uniform sky" | "gleichförmiger Himmel";
    const PEREZ_SKY = "Perez sky" | "Perez-Himmel";
    const MEASURED_SKY = "measured sky" | "gemessener Himmel";
    const WEATHER_SKY = "weather file" | "Wetterdatei";
    const LIST_CIE = "CIE general sky" | "CIE-Himmel";
    const LIST_UNIFORM = "Uniform" | "Gleichförmig";
    const LIST_PEREZ = "Perez all-weather" | "Perez (alle Wetter)";
    const LIST_SCAN = "Measured (file)" | "Gemessen (Datei)";
    const LIST_WEATHER = "Hour of a weather file" | "Stunde einer Wetterdatei";

    // How exact.
    const NO_ERROR_STATED = "no error stated" | "keine Unsicherheit angegeben";
    const ERROR_TINY = "error < 0.01 % of each value" | "Unsicherheit < 0,01 % jedes Werts";
    fn error_large(percent) = "UNCERTAIN: error up to {percent} % of a value" | "UNSICHER: Unsicherheit bis {percent} % eines Werts";
    fn error_at_most(percent) = "error ≤ {percent} % of each value" | "Unsicherheit ≤ {percent} % jedes Werts";

    // The direction of incidence.
    const THE_SUN = "sun" | "Sonne";
    const CHOSEN_DIRECTION = "chosen direction" | "gewählte Richtung";
    const PERPENDICULAR = "perpendicular light" | "senkrechtes Licht";
    fn with_profile(angles, profile) = "{angles}, profile angle {profile}" | "{angles}, Profilwinkel {profile}";
    fn incidence(name, angles) = "{name} at {angles}" | "{name} bei {angles}";
    const SUN_BEHIND = " (sun not before the façade)" | " (Sonne nicht vor der Fassade)";

    // Rules of control.
    const BY_HAND = "By hand" | "Von Hand";
    const BY_HAND_DOES = "fixed by hand" | "von Hand gestellt";
    const BY_HAND_ORDER = "by hand" | "von Hand";
    const BY_HAND_TIP = "The state stays where [ and ] put it" | "Die Stellung bleibt, wie [ und ] sie wählen";
    const CURVE = "Curve" | "Kurve";
    const CURVE_DOES = "follows the curve" | "folgt der Kurve";
    const CURVE_ORDER = "follow the curve" | "der Kurve folgen";
    const CURVE_TIP = "The state that a curve asks for at the sun's profile angle: the product's, or one edited in the tile" | "Die Stellung, die eine Kurve beim Profilwinkel der Sonne verlangt: die des Produkts oder eine in der Kachel bearbeitete";
    const CUT_OFF = "Cut-off" | "Cut-off";
    const CUT_OFF_DOES = "keeps the sun just out (cut-off)" | "hält die Sonne gerade ab (Cut-off)";
    const CUT_OFF_ORDER = "keep the sun just out (cut-off)" | "Sonne gerade abhalten (Cut-off)";
    const CUT_OFF_TIP = "The most open state that lets no direct sun through, the whole disc counted" | "Die offenste Stellung, die keine direkte Sonne durchlässt, die ganze Sonnenscheibe gerechnet";
    const DIN_5034 = "DIN 5034" | "DIN 5034";
    const DIN_5034_DOES = "closed in sun (DIN 5034)" | "bei Sonne geschlossen (DIN 5034)";
    const DIN_5034_TIP = "The most closed state while the sun is on the façade, else the most open" | "Die geschlossenste Stellung, solange die Sonne auf die Fassade scheint, sonst die offenste";
    const RETRO = "Retro-reflect" | "Rückreflexion";
    const RETRO_DOES = "throws the sun back" | "wirft die Sonne zurück";
    const RETRO_ORDER = "throw the sun back" | "Sonne zurückwerfen";
    const RETRO_TIP = "Mirror slats stand across the beam: 90° − ψ, for the lower part of a window" | "Spiegellamellen stehen quer zum Strahl: 90° − ψ, für den unteren Teil eines Fensters";
    const REDIRECT = "Redirect" | "Umlenken";
    const REDIRECT_DOES = "redirects the sun" | "lenkt die Sonne um";
    const REDIRECT_ORDER = "redirect the sun" | "Sonne umlenken";
    const REDIRECT_TIP = "Mirror slats send the sun to the ceiling: half of (elevation − ψ), for the upper part of a window" | "Spiegellamellen lenken die Sonne an die Decke: die Hälfte von (Höhenwinkel − ψ), für den oberen Teil eines Fensters";
    const USER = "User" | "Nutzer";
    const USER_DOES = "by the user's clock" | "nach der Uhr des Nutzers";
    const USER_TIP = "A state by hours of the day; the hours are set in the scene file" | "Eine Stellung nach Tagesstunden; die Stunden stehen in der Szenendatei";
    const TABLE = "Table" | "Tabelle";
    const TABLE_DOES = "by a table" | "nach einer Tabelle";
    const TABLE_TIP = "States given from elsewhere, row by row in time; the file is named in the scene file" | "Stellungen von anderswo, Zeile für Zeile in der Zeit; die Datei steht in der Szenendatei";
    const SLAT_ANGLE = "slat angle / °" | "Lamelle / °";
    const STATE_ANGLE = "state / °" | "Stellung / °";
    const STATE = "state" | "Stellung";

    // Provenance.
    const MEASURED = "measured" | "gemessen";
    const COMPUTED = "computed" | "berechnet";
    const UNKNOWN = "unknown" | "unbekannt";
    const INFO = "info" | "Hinweis";
    const WARNING = "warning" | "Warnung";
    const ERROR = "error" | "Fehler";

    // Thermal data and extents of datasets.
    const CONDUCTIVITY = "conductivity" | "Wärmeleitfähigkeit";
    const AIR_PERMEABILITY = "air permeability" | "Luftdurchlässigkeit";
    const EMISSIVITY_FRONT = "front emissivity" | "Emissionsgrad außen";
    const EMISSIVITY_BACK = "back emissivity" | "Emissionsgrad innen";
    const INFRARED_TRANSMITTANCE = "infrared transmittance" | "Infrarot-Transmissionsgrad";
    const EFFECTIVE_OPENNESS = "effective openness" | "wirksame Offenheit";
    const PERMEABILITY = "permeability factor" | "Durchlässigkeitsfaktor";
    const WIDTH = "width" | "Breite";
    const HEIGHT = "height" | "Höhe";

    // Stages of a computation, and sources of sharp beams.
    const STAGE_SUN = "sun" | "Sonne";
    const STAGE_GROUND = "ground" | "Boden";
    const STAGE_CELLS = "cells" | "Zellen";
    const STAGE_DESCRIPTION = "description" | "Beschreibung";
    const STAGE_SEEN_THROUGH = "seen through" | "Durchsicht";
    const STAGE_SKY_AT_SENSORS = "sky at sensors" | "Himmel an den Messpunkten";
    const STAGE_OTHER_STATES = "other states" | "andere Stellungen";
    const STAGE_NEAR_FIELD = "near field" | "Nahfeld";
    const STAGE_INTERREFLECTION = "interreflection" | "Interreflexion";
    const STAGE_BACK_REFLECTION = "back reflection" | "Rückreflexion der Öffnung";
    const STAGE_EMISSION = "emission" | "Abstrahlung";
    const STAGE_INTERPOLATION = "interpolation" | "Interpolation";
    const STAGE_DIRECT = "direct" | "direkt";
    const STAGE_RECEPTIONS = "receptions" | "Empfang der Messpunkte";
    const STAGE_ROOM_FACTORS = "room factors" | "Raumfaktoren";
    const STAGE_UNSEEN_CELLS = "unseen cells" | "ungesehene Zellen";
    const BEAM_NONE = "none" | "keiner";
    const BEAM_DESCRIBED = "described" | "beschrieben";
    const BEAM_EXTRACTED = "extracted" | "herausgelöst";
    const BEAM_CELLS = "cells" | "auf Zellen";

    // Candidates.
    const IDEAL_TRANSPARENT = "ideal transparent" | "ideal durchsichtig";
    const IDEAL_DIFFUSE = "ideal diffuse" | "ideal streuend";
    const AS_IN_SCENE = "as in the scene" | "wie in der Szene";

    // A year of control.
    const YEAR_NEEDS_DATE = "No year of control: the sun is given by angles. Choose “By date and time” in the scene." | "Kein Jahr der Regelung: Die Sonne ist durch Winkel gegeben. In der Szene „Nach Datum und Zeit“ wählen.";
    fn no_year(problem) = "No year of control: {problem}" | "Kein Jahr der Regelung: {problem}";

    // Obstructions.
    fn boxes_below_ground(count, height) = "{count} of the boxes outside: not above the ground at {height} m (site.ground_height), so not there" | "{count} der Körper draußen: nicht über dem Boden auf {height} m (site.ground_height), also nicht da";
    fn boxes_left_out(count) = "{count} of the boxes outside: left out, too low and too far away to matter" | "{count} der Körper draußen: weggelassen, zu niedrig und zu fern, um etwas zu ändern";
    const BUILDING_UNNAMED = "no [building] named: of the building only the boxes shade the ground" | "kein [building] benannt: Vom Gebäude beschatten nur die Körper den Boden";
    fn past_outside(number) = "aperture {number}: every sensor looks straight through and past what stands outside" | "Öffnung {number}: Jeder Messpunkt blickt gerade hindurch und an dem vorbei, was draußen steht";
    fn outside_alike(number, change) = "aperture {number}: not split, its points see the outside alike (light changes by {change} %)" | "Öffnung {number}: nicht geteilt, ihre Punkte sehen dasselbe Außen (das Licht ändert sich um {change} %)";
    fn outside_one_part(number, change) = "aperture {number}: split into one part, each with its own outside; over a part light still changes, smoothly, by up to {change} %" | "Öffnung {number}: ein Teil mit eigenem Außen; über den Teil ändert sich das Licht noch stetig, um bis zu {change} %";
    fn outside_parts(number, parts, change) = "aperture {number}: split into {parts} parts, each with its own outside; over a part light still changes, smoothly, by up to {change} %" | "Öffnung {number}: in {parts} Teile mit je eigenem Außen geteilt; über einen Teil ändert sich das Licht noch stetig, um bis zu {change} %";
    fn sun_on_all(number) = "aperture {number}: the sun reaches all of it" | "Öffnung {number}: Die Sonne erreicht sie ganz";
    fn sun_on_none(number) = "aperture {number}: wholly in the shade of what stands outside" | "Öffnung {number}: ganz im Schatten dessen, was draußen steht";
    fn sun_on_part(number, share) = "aperture {number}: the sun reaches {share} % of it, cut along the edges of the shadows" | "Öffnung {number}: Die Sonne erreicht {share} % von ihr, an den Schattenkanten scharf geschnitten";

    // Leaving out.
    fn left_out(label, count, means) = "{label}: each of {count} incident directions left out and foretold from those around it, flux misplaced in the mean: {means}." | "{label}: Jede von {count} Einfallsrichtungen wurde weggelassen und aus ihren Nachbarn vorhergesagt; im Mittel fehlgeleiteter Lichtstrom: {means}.";
    fn better_scheme(scheme, count, gain, theta, phi, own, responses) = " {scheme} would be better than responses at {count}, at most by {gain} (θ {theta}°, φ {phi}°: {own} against {responses})." | " {scheme} wäre besser als responses an {count} Richtungen, höchstens um {gain} (θ {theta}°, φ {phi}°: {own} gegen {responses}).";
    fn stated_for_sun(share) = " Stated for the sun at the data's own spacing: {share}." | " Angegeben für die Sonne beim Abstand der Daten selbst: {share}.";

    // Accuracy.
    const DIRECT = "direct" | "direkt";
    const TOTAL = "total" | "gesamt";
    const WITH_INTERREFLECTION = "with interreflection" | "mit Interreflexion";
    const AXIS_STATED = "stated error" | "angegebene Unsicherheit";
    const AXIS_TIME = "time a new sky" | "Zeit je neuem Himmel";
    fn rms(error) = "{error} (RMS)" | "{error} (RMS)";
    const KIND_FINEST = "numerical error against this method's finest run" | "numerischer Fehler gegen den feinsten Lauf dieses Verfahrens";
    fn kind_given(name) = "true error against {name}" | "wahrer Fehler gegen {name}";
    const AXIS_FINEST = "error to finest run" | "Fehler zum feinsten Lauf";
    const AXIS_TRUE = "true error" | "wahrer Fehler";
    const AXIS_REFERENCE = "error to reference" | "Fehler zur Referenz";
    fn finest_direct(target, stated, rms, max) = "Reference of the direct illuminance: the ordinary method's finest run, error target {target}, states {stated}; from the second finest it lies {rms} RMS, {max} at most. What the method or the data leave out is not seen so." | "Referenz der direkten Beleuchtungsstärke: der feinste Lauf des üblichen Verfahrens, Fehlerziel {target}, gibt {stated} an; vom zweitfeinsten weicht er {rms} RMS ab, höchstens {max}. Was Verfahren oder Daten auslassen, ist so nicht zu sehen.";
    fn finest_total(target, stated, rms, max) = "Reference of the total illuminance: the ordinary method's finest run, error target {target}, states {stated}; from the second finest it lies {rms} RMS, {max} at most. What the method or the data leave out is not seen so." | "Referenz der gesamten Beleuchtungsstärke: der feinste Lauf des üblichen Verfahrens, Fehlerziel {target}, gibt {stated} an; vom zweitfeinsten weicht er {rms} RMS ab, höchstens {max}. Was Verfahren oder Daten auslassen, ist so nicht zu sehen.";
    fn given_direct(name, stated) = "Reference of the direct illuminance: {name}, by its own statement good to {stated} or better." | "Referenz der direkten Beleuchtungsstärke: {name}, nach eigener Angabe auf {stated} oder besser genau.";
    fn given_total(name, stated) = "Reference of the total illuminance: {name}, by its own statement good to {stated} or better." | "Referenz der gesamten Beleuchtungsstärke: {name}, nach eigener Angabe auf {stated} oder besser genau.";
    fn undetermined_finest(open, stated, difference) = "no error told: the finest run hardly refines this one (it states {open}, this one {stated}, they differ by {difference})" | "kein Fehler angegeben: Der feinste Lauf verfeinert diesen kaum (er gibt {open} an, dieser {stated}, sie weichen um {difference} voneinander ab)";
    fn undetermined_given(name, open, stated, difference) = "no error told: {name} is itself open by {open}, this run states {stated}, they differ by {difference}" | "kein Fehler angegeben: {name} ist selbst um {open} offen, dieser Lauf gibt {stated} an, sie weichen um {difference} voneinander ab";
    fn effort_enough(data, own) = "more effort does not help: the data leave ± {data} open, the computation ± {own}" | "mehr Aufwand hilft nicht: Die Daten lassen ± {data} offen, die Rechnung ± {own}";
    fn effort_enough_from(setting, data, own) = "more effort than {setting} does not help: the data leave ± {data} open, the computation ± {own}" | "mehr Aufwand als {setting} hilft nicht: Die Daten lassen ± {data} offen, die Rechnung ± {own}";
}

use super::Text;

/// Short names of the months, beginning with January.
pub const MONTHS: [Text; 12] =
    [JANUARY, FEBRUARY, MARCH, APRIL, MAY, JUNE, JULY, AUGUST, SEPTEMBER, OCTOBER, NOVEMBER, DECEMBER];
