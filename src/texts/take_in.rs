//! Taking products in and changing them: import, questions, findings, history.

texts! {
    const IMPORT = "Import" | "Import";
}
