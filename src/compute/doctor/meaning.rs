//! What findings mean for results, by their code.

/// One sentence on what a finding of this code does to results; empty for codes that speak for themselves.
pub fn meaning(code: &str) -> &'static str {
    match code {
        "percent" => "Rooms would be lit 100 times too brightly.",
        "cosine-factor" => {
            "Light at grazing angles is weighed wrongly: ceilings and walls are too dark or too bright, and τ is wrong."
        }
        "upside-down-block" | "maybe-upside-down" => {
            "Light that should reach the ceiling would fall on the floor by the window, or the reverse; sun protection would seem to fail."
        }
        "mirrored-block" => "Morning and afternoon would be exchanged for this function.",
        "transposed-block" => {
            "Transmittance is read from the wrong directions: amounts, their change over the day and the light's way are wrong."
        }
        "sides-swapped" | "maybe-sides-swapped" => {
            "Light would meet the system from the wrong side: other transmittances, another reflectance towards the room."
        }
        "copied-block" => {
            "One side's function is taken for the other's; results for that side are those of another system."
        }
        "block-mislabelled" => "The block is no reflection; used as one, interreflection in the room would be wrong.",
        "band-copied" => {
            "Solar gains computed from these data would be those of light, or light those of the solar band."
        }
        "missing-block" => {
            "What depends on it is derived or assumed; daylight from outside needs the front transmission and the reflection of the room side."
        }
        "zero-block" => "The side counts as black: interreflection between it and the room is lost.",
        "front-zero" | "opaque" => "No light enters the room.",
        "back-zero" | "back-placeholder" => {
            "Light from outside is not affected; the way out is taken from it by reciprocity."
        }
        "no-transmission" => "The system cannot light a room.",
        "energy-above-one" => "Results are too bright by as much as the sum exceeds 1, from those directions.",
        "negative-values" => "Negative luminances would be subtracted from the light of other directions.",
        "not-a-number" => "Every result would be no number.",
        "missing-patches" => {
            "From those directions the room would be dark; whenever the sun stands there results are too low."
        }
        "grazing-spike" => "A low or sideways sun would be transmitted too strongly.",
        "reciprocity" => {
            "How far the two sides can be trusted together; only the function of the side in use enters a result."
        }
        "symmetry" => "Where the system must look the same and where it must not.",
        "symmetry-declared" => {
            "Suns from different sides at the same angle would give the same light, which is wrong for such a system."
        }
        "orientation" | "sides" => "The one thing that numbers cannot show: compare it with the product.",
        "resolution" => "Finer effects than the cells are averaged away.",
        "template-word" | "no-identity" => "Nobody can tell later whose data these are; results are not affected.",
        "side-not-told" | "front-by-reciprocity" => "As good as the back transmission that it is derived from.",
        "incomplete-matrix" => "Almost all directions are dark: only good for testing.",
        "several-layers" => "The other layers are missing from every result.",
        "layers-not-read" => "Light passes the system as a whole, which the file describes by data of its own.",
        "thickness-unreadable" | "thickness-implausible" => "Only the section drawing needs the thickness.",
        "band-not-read" => "Daylight needs the visible band alone.",
        _ => "",
    }
}
