//! The scene: place, time, sky, apertures, room.

texts! {
    const SCENE = "Scene" | "Szene";
}
