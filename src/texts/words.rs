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
    fn high(angle) = "at {angle}" | "in {angle} Höhe";
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
    fn sun_by_angles(height, bearing) = "sun {height}, azimuth {bearing}°" | "Sonne {height}, Azimut {bearing}°";
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
    const WEATHER_SKY = "weather hour" | "Wetterstunde";
    const LIST_CIE = "CIE general sky" | "Allgemeiner CIE-Himmel";
    const LIST_UNIFORM = "Uniform sky" | "Gleichförmiger Himmel";
    const LIST_PEREZ = "Perez all-weather" | "Perez-Himmel";
    const LIST_SCAN = "Measured sky (scan)" | "Gemessener Himmel (Scan)";
    const LIST_WEATHER = "Weather hour" | "Wetterstunde";

    // How exact.
    const NO_ERROR_STATED = "no uncertainty stated" | "keine Unsicherheit angegeben";
    const ERROR_TINY = "uncertainty < 0.01 % of each value" | "Unsicherheit < 0,01 % jedes Werts";
    fn error_large(percent) = "UNCERTAIN: up to ± {percent} % of a value" | "UNSICHER: bis ± {percent} % eines Werts";
    fn error_at_most(percent) = "uncertainty ≤ {percent} % of each value" | "Unsicherheit ≤ {percent} % jedes Werts";

    // The direction of incidence.
    const THE_SUN = "sun" | "Sonne";
    const CHOSEN_DIRECTION = "chosen direction" | "gewählte Richtung";
    const PERPENDICULAR = "normal incidence" | "senkrechter Einfall";
    fn with_profile(angles, profile) = "{angles}, profile angle {profile}" | "{angles}, Profilwinkel {profile}";
    fn incidence(name, angles) = "{name} at {angles}" | "{name} bei {angles}";
    const SUN_BEHIND = " (sun not in front of the façade)" | " (Sonne nicht vor der Fassade)";

    // Rules of control.
    const BY_HAND = "Manual" | "Manuell";
    const BY_HAND_DOES = "fixed manually" | "manuell gestellt";
    const BY_HAND_ORDER = "manual" | "manuell";
    const BY_HAND_TIP = "Keeps the state that is set by hand, e.g. with [ and ]" | "Behält die von Hand gewählte Stellung, z. B. mit [ und ]";
    const CURVE = "Curve" | "Kurve";
    const CURVE_DOES = "follows the control curve" | "folgt der Steuerkurve";
    const CURVE_ORDER = "follow the control curve" | "der Steuerkurve folgen";
    const CURVE_TIP = "Sets the state that a control curve gives for the sun's profile angle: the curve of the product, or one edited in the tile" | "Stellt die Stellung ein, die eine Steuerkurve für den Profilwinkel der Sonne vorgibt: die des Produkts oder eine in der Kachel bearbeitete";
    const CUT_OFF = "Cut-off" | "Cut-off";
    const CUT_OFF_DOES = "just blocks direct sun (cut-off)" | "hält direkte Sonne gerade ab (Cut-off)";
    const CUT_OFF_ORDER = "just block direct sun (cut-off)" | "direkte Sonne gerade abhalten (Cut-off)";
    const CUT_OFF_TIP = "Sets the most open state that just blocks direct sun, for the whole solar disc" | "Stellt die offenste Stellung ein, die direktes Sonnenlicht gerade abhält, für die ganze Sonnenscheibe";
    const DIN_5034 = "DIN 5034" | "DIN 5034";
    const DIN_5034_DOES = "closed in sun (DIN 5034)" | "bei Sonne geschlossen (DIN 5034)";
    const DIN_5034_TIP = "Sets the most closed state while the sun is on the façade, otherwise the most open" | "Stellt die geschlossenste Stellung ein, solange die Sonne auf die Fassade scheint, sonst die offenste";
    const RETRO = "Retro-reflect" | "Rückreflexion";
    const RETRO_DOES = "reflects the sun back" | "reflektiert die Sonne zurück";
    const RETRO_ORDER = "reflect the sun back" | "Sonne zurückreflektieren";
    const RETRO_TIP = "Sets mirror slats perpendicular to the sun, 90° − ψ; for the lower part of a façade" | "Stellt Spiegellamellen senkrecht zur Sonne, 90° − ψ; für den unteren Teil einer Fassade";
    const REDIRECT = "Redirect" | "Umlenken";
    const REDIRECT_DOES = "redirects the sun" | "lenkt die Sonne um";
    const REDIRECT_ORDER = "redirect the sun" | "Sonne umlenken";
    const REDIRECT_TIP = "Sets mirror slats to redirect the sun to the ceiling, half of (elevation − ψ); for the upper part of a façade" | "Stellt Spiegellamellen so, dass sie die Sonne an die Decke lenken, Hälfte von (Höhenwinkel − ψ); für den oberen Teil einer Fassade";
    const USER = "Schedule" | "Zeitplan";
    const USER_DOES = "follows a schedule" | "folgt einem Zeitplan";
    const USER_TIP = "Sets a state by the time of day; the hours are in the scene file" | "Stellt eine Stellung nach der Tageszeit ein; die Stunden stehen in der Szenendatei";
    const TABLE = "Table" | "Tabelle";
    const TABLE_DOES = "follows a table" | "folgt einer Tabelle";
    const TABLE_TIP = "Reads external states, one row per time step; the file is named in the scene file" | "Liest externe Stellungen, eine Zeile je Zeitschritt; die Datei ist in der Szenendatei genannt";
    const SLAT_ANGLE = "slat angle / °" | "Lamellenwinkel / °";
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
    const STAGE_SUN = "direct sun" | "direkte Sonne";
    const STAGE_GROUND = "ground" | "Boden";
    const STAGE_CELLS = "patch-averaged data" | "über Felder gemittelte Daten";
    const STAGE_DESCRIPTION = "description" | "Beschreibung";
    const STAGE_SEEN_THROUGH = "view through apertures" | "Durchsicht";
    const STAGE_SKY_AT_SENSORS = "sky at points" | "Himmel an den Punkten";
    const STAGE_OTHER_STATES = "other states" | "andere Stellungen";
    const STAGE_NEAR_FIELD = "near field" | "Nahfeld";
    const STAGE_INTERREFLECTION = "interreflection" | "Interreflexion";
    const STAGE_BACK_REFLECTION = "back reflection" | "raumseitige Reflexion";
    const STAGE_EMISSION = "emission" | "Abstrahlung";
    const STAGE_INTERPOLATION = "interpolation" | "Interpolation";
    const STAGE_DIRECT = "direct" | "direkt";
    const STAGE_RECEPTIONS = "light at points" | "Licht an den Punkten";
    const STAGE_ROOM_FACTORS = "room factors" | "Raumfaktoren";
    const STAGE_UNSEEN_CELLS = "directions that reach no sensor" | "Richtungen, die keinen Punkt treffen";
    const BEAM_NONE = "none" | "keines";
    const BEAM_DESCRIBED = "from description" | "aus Beschreibung";
    const BEAM_EXTRACTED = "extracted" | "extrahiert";
    const BEAM_CELLS = "patch-averaged" | "über Felder gemittelt";

    // Candidates.
    const IDEAL_TRANSPARENT = "ideal clear" | "ideal klar";
    const IDEAL_DIFFUSE = "ideal diffuser" | "ideal diffus streuend";
    const AS_IN_SCENE = "as in the scene" | "wie in der Szene";

    // A year of control.
    const YEAR_NEEDS_DATE = "No control over the year: the sun is given by angles. Select “By date and time” in the scene." | "Keine Steuerung übers Jahr: Die Sonne ist durch Winkel gegeben. In der Szene „Nach Datum und Zeit“ wählen.";
    fn no_year(problem) = "No control over the year: {problem}" | "Keine Steuerung übers Jahr: {problem}";

    // Obstructions.
    fn boxes_below_ground(count, height) = "obstructions below the ground at {height} m (site.ground_height), without effect: {count}" | "Verbauungen unter dem Boden in {height} m (site.ground_height), ohne Wirkung: {count}";
    fn boxes_left_out(count) = "obstructions too low and too distant to matter, left out: {count}" | "Verbauungen, zu niedrig und zu fern für eine Wirkung, ausgelassen: {count}";
    const BUILDING_UNNAMED = "no [building] specified: of the building only the obstruction boxes shade the ground" | "kein [building] angegeben: Vom Gebäude beschatten nur die Quader den Boden";
    fn past_outside(number) = "aperture {number}: all calculation points see the sky through it past the obstructions" | "Öffnung {number}: Alle Berechnungspunkte sehen durch sie an den Verbauungen vorbei";
    fn outside_alike(number, change) = "aperture {number}: not subdivided, its points see the same obstructions (light changes by {change} %)" | "Öffnung {number}: nicht unterteilt, ihre Punkte sehen dieselben Verbauungen (das Licht ändert sich um {change} %)";
    fn outside_one_part(number, change) = "aperture {number}: not subdivided; the light from outside varies by up to {change} % over it" | "Öffnung {number}: ungeteilt; das Licht von außen ändert sich darin um bis zu {change} %";
    fn outside_parts(number, parts, change) = "aperture {number}: subdivided into {parts} parts, each with its own view of the obstructions; the light from outside varies by up to {change} % over a part" | "Öffnung {number}: in {parts} Teile mit je eigener Sicht auf die Verbauungen unterteilt; das Licht von außen ändert sich in einem Teil um bis zu {change} %";
    fn sun_on_all(number) = "aperture {number}: fully sunlit" | "Öffnung {number}: ganz besonnt";
    fn sun_on_none(number) = "aperture {number}: fully shaded by obstructions" | "Öffnung {number}: ganz von Verbauungen beschattet";
    fn sun_on_part(number, share) = "aperture {number}: {share} % sunlit, with sharp shadow edges" | "Öffnung {number}: zu {share} % besonnt, mit scharfen Schattenkanten";

    // Leaving out.
    fn left_out(label, count, means) = "{label}: each of {count} incident directions omitted and predicted from its neighbours; flux misplaced on average: {means}." | "{label}: Jede von {count} Einfallsrichtungen wurde ausgelassen und aus ihren Nachbarn vorhergesagt; im Mittel fehlgeleiteter Lichtstrom: {means}.";
    fn better_scheme(scheme, count, gain, theta, phi, own, responses) = " {scheme} would be better than responses at {count}, at most by {gain} (θ {theta}°, φ {phi}°: {own} against {responses})." | " {scheme} wäre besser als responses an {count} Richtungen, höchstens um {gain} (θ {theta}°, φ {phi}°: {own} gegen {responses}).";
    fn stated_for_sun(share) = " Stated for the sun at the spacing of the data: {share}." | " Angegeben für die Sonne beim Abstand der Daten: {share}.";

    // Accuracy.
    const DIRECT = "direct" | "direkt";
    const TOTAL = "total" | "gesamt";
    const WITH_INTERREFLECTION = "with interreflection" | "mit Interreflexion";
    const AXIS_STATED = "stated uncertainty" | "angegebene Unsicherheit";
    const AXIS_TIME = "time per new sky" | "Zeit je neuem Himmel";
    fn rms(error) = "{error} (RMS)" | "{error} (RMS)";
    const KIND_FINEST = "numerical error against this method's finest run" | "numerischer Fehler gegen den feinsten Lauf dieses Verfahrens";
    fn kind_given(name) = "true error against {name}" | "wahrer Fehler gegen {name}";
    const AXIS_FINEST = "error to finest run" | "Abweichung vom feinsten Lauf";
    const AXIS_TRUE = "true error" | "wahrer Fehler";
    const AXIS_REFERENCE = "error to reference" | "Abweichung vom Bezug";
    fn finest_direct(target, stated, rms, max) = "Reference of the direct illuminance: finest run of the default method, error target {target}, states {stated}; the second finest differs from it by {rms} RMS, {max} at most. This does not show what the method or the data neglect." | "Bezug der direkten Beleuchtungsstärke: der feinste Lauf des Vorgabeverfahrens, Zielwert der Unsicherheit {target}, gibt {stated} an; der zweitfeinste weicht um {rms} RMS ab, höchstens {max}. Was Verfahren oder Daten vernachlässigen, zeigt sich so nicht.";
    fn finest_total(target, stated, rms, max) = "Reference of the total illuminance: finest run of the default method, error target {target}, states {stated}; the second finest differs from it by {rms} RMS, {max} at most. This does not show what the method or the data neglect." | "Bezug der gesamten Beleuchtungsstärke: der feinste Lauf des Vorgabeverfahrens, Zielwert der Unsicherheit {target}, gibt {stated} an; der zweitfeinste weicht um {rms} RMS ab, höchstens {max}. Was Verfahren oder Daten vernachlässigen, zeigt sich so nicht.";
    fn given_direct(name, stated) = "Reference of the direct illuminance: {name}, with a stated uncertainty of {stated} or better." | "Referenz der direkten Beleuchtungsstärke: {name}, mit einer angegebenen Unsicherheit von {stated} oder besser.";
    fn given_total(name, stated) = "Reference of the total illuminance: {name}, with a stated uncertainty of {stated} or better." | "Bezug der gesamten Beleuchtungsstärke: {name}, mit einer angegebenen Unsicherheit von {stated} oder besser.";
    fn undetermined_finest(open, stated, difference) = "no error reported: the finest run hardly refines this one (it states {open}, this one {stated}, they differ by {difference})" | "keine Abweichung angegeben: Der feinste Lauf verfeinert diesen kaum (er gibt {open} an, dieser {stated}, sie weichen um {difference} voneinander ab)";
    fn undetermined_given(name, open, stated, difference) = "no error reported: {name} itself is uncertain by {open}, this run states {stated}, they differ by {difference}" | "keine Abweichung angegeben: {name} ist selbst um {open} unsicher, dieser Lauf gibt {stated} an, sie weichen um {difference} voneinander ab";
    fn effort_enough(data, own) = "more effort does not help: uncertainty of the data ± {data}, of the computation ± {own}" | "mehr Aufwand hilft nicht: Unsicherheit der Daten ± {data}, der Rechnung ± {own}";
    fn effort_enough_from(setting, data, own) = "more effort than {setting} does not help: uncertainty of the data ± {data}, of the computation ± {own}" | "mehr Aufwand als {setting} hilft nicht: Unsicherheit der Daten ± {data}, der Rechnung ± {own}";
}

use super::Text;

/// Short names of the months, beginning with January.
pub const MONTHS: [Text; 12] =
    [JANUARY, FEBRUARY, MARCH, APRIL, MAY, JUNE, JULY, AUGUST, SEPTEMBER, OCTOBER, NOVEMBER, DECEMBER];
