//! Menus, commands, palette, keys, status and messages.

texts! {
    const AS_THE_DESKTOP = "as the desktop" | "wie der Desktop";
    const LANGUAGE_TIP = "The language of the window, its pictures and its reports" | "Die Sprache des Fensters, seiner Bilder und Berichte";
    fn language_is(name) = "Language: {name}" | "Sprache: {name}";
}
