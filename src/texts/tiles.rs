//! The tiles of the bench and what stands in them.

texts! {
    const SKY = "Sky" | "Himmel";
}
