//! Comparing products, states, moments and rooms.

texts! {
    const COMPARE = "Compare" | "Vergleichen";
}
