//! Which system for this façade.

texts! {
    const CHOOSE = "Choose" | "Wählen";
    const CHOOSE_ABOUT = "Products of the catalogue in this room, through a year, by objectives and weights. What the errors cannot tell apart shares a rank.\nA diamond: no other is better in every objective. A double tilde: approximate figures." | "Produkte des Katalogs in diesem Raum, durch ein Jahr, nach Zielen und Gewichten. Was die Unsicherheiten nicht trennen, teilt einen Rang.\nEine Raute: keines ist in jedem Ziel besser. Eine doppelte Tilde: Kennwerte als Näherung.";
    const NOTHING_YET = "Nothing is ranked yet." | "Noch ist nichts gereiht.";
    fn done(done, all) = "{done} of {all} products" | "{done} von {all} Produkten";
    fn shown(shown, all) = "{shown} of {all} shown" | "{shown} von {all} gezeigt";
    const FILTER = "filter" | "filtern";
    const FRONT_ONLY = "front" | "Front";
    const FRONT_TIP = "Only products that no other is better than in every objective" | "Nur Produkte, zu denen keines in jedem Ziel besser ist";
    const EXCLUDED_TOO = "excluded" | "ausgeschlossene";
    const EXCLUDED_TIP = "Products that take no part too, with the reason" | "Auch Produkte, die nicht teilnehmen, mit dem Grund";
    const PLOT = "plot" | "Diagramm";
    const PLOT_TIP = "Two objectives against each other" | "Zwei Ziele gegeneinander";
    const PLOT_NAME = "Objectives against each other" | "Ziele gegeneinander";
    const PLOT_FOOT = "Point at a product to read why it stands there" | "Auf ein Produkt zeigen, um zu lesen, warum es dort steht";
    const WEIGHTS = "Weights" | "Gewichte";
    const ACROSS = "to the right" | "nach rechts";
    const UP = "upwards" | "nach oben";
    const RANK = "Rank" | "Rang";
    const PRODUCT = "Product" | "Produkt";
    const WORTH = "Worth" | "Wert";
    const WORTH_TIP = "Mean of what the objectives are worth, by their weights: 0 at their worst, 1 at their best" | "Mittel dessen, was die Ziele wert sind, nach Gewichten: 0 beim schlechtesten, 1 beim besten";
    fn worth(value, error) = "{value} ± {error}" | "{value} ± {error}";
    const LESS_IS_BETTER = "less is better" | "weniger ist besser";
    const MORE_IS_BETTER = "more is better" | "mehr ist besser";
    const MARKS_TIP = "◆ no other is better in every objective · ≈ approximate · ⌂ in the room" | "◆ keines in jedem Ziel besser · ≈ Näherung · ⌂ im Raum";
    const INTO_ROOM = "Into the room" | "In den Raum";
    const INTO_ROOM_TIP = "This product takes the place of the one in the room" | "Dieses Produkt tritt an die Stelle dessen im Raum";
    const INTO_TRAY = "Into the comparison" | "In den Vergleich";
    const INTO_TRAY_TIP = "This product into the comparison's tray" | "Dieses Produkt in die Ablage des Vergleichs";
    fn excluded_because(reason) = "Takes no part: {reason}" | "Nimmt nicht teil: {reason}";
}
