//! Handing on: luminaire files, pictures, reports.

texts! {
    const HAND_ON = "Hand on" | "Weitergeben";
}
