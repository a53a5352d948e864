//! Texts of the stages of computations; the layers below name the stages in English.

texts! {
    const ACCURACY = "accuracy" | "Genauigkeit";
    const APERTURES = "apertures" | "Öffnungen";
    const CHECKS = "checks" | "Prüfungen";
    const COEFFICIENTS = "coefficients" | "Koeffizienten";
    const COMPUTING = "computing" | "Berechnung";
    const CONTROL = "control" | "Steuerung";
    const DAYS = "days" | "Tage";
    const DIRECT_LIGHT = "direct light" | "direktes Licht";
    const DIRECT = "direct" | "direkt";
    const FIGURES = "figures" | "Kennwerte";
    const FILES = "files" | "Dateien";
    const GLARE = "glare" | "Blendung";
    const GONIOPHOTOMETER = "goniophotometer" | "Goniophotometer";
    const HOLES = "holes" | "Löcher";
    const HOURS = "hours" | "Stunden";
    const INTERREFLECTION = "interreflection" | "Interreflexion";
    const LAYERS = "layers" | "Schichten";
    const INTENSITIES = "luminous intensities" | "Lichtstärken";
    const MOMENTS = "moments" | "Zeitpunkte";
    const OBSTRUCTIONS = "obstructions" | "Verbauungen";
    const OUTSIDE = "outside" | "außen";
    const PACKAGES = "packages" | "Pakete";
    const PRODUCTS = "products" | "Produkte";
    const PRODUCTS_COARSE = "products, coarse" | "Produkte, grob";
    const ROOM = "room" | "Raum";
    const SCENE = "scene" | "Szene";
    const SLATS = "slats" | "Lamellen";
    const SOLAR = "solar" | "Solarenergie";
    const STATES = "states" | "Stellungen";
    const SURFACES = "surfaces" | "Flächen";
    const TILES = "tiles" | "Kacheln";
    const WEATHER = "weather" | "Wetter";
    const WAITING = "waiting for the product's data" | "Warten auf Produktdaten";
}

/// Returns the text for a stage in the current language; an unknown stage unchanged.
pub fn word(stage: &'static str) -> &'static str {
    match super::language() {
        super::Language::English => stage,
        super::Language::German => {
            PAIRS.iter().find(|(english, _)| *english == stage).map_or(stage, |(_, german)| german)
        }
    }
}
