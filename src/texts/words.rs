//! Words of the layers below the window: figures, reasons, findings, errors.

texts! {
    const SUN = "sun" | "Sonne";
}
