//! Rankings as JSON, with the contributions to every difference.

use crate::compute::rank::{Better, Objective, Why};
use crate::study::rank::{Found, List, why};
use serde_json::{Map, Value, json};

/// Returns all ranked lists as JSON, in their order.
pub(super) fn to_json(lists: &[List]) -> Value {
    json!({ "lists": lists.iter().map(list).collect::<Vec<_>>() })
}

fn list(list: &List) -> Value {
    let (ranked, ranking) = (list.ranked(), list.ranking(&list.objectives));
    let names: Vec<_> = ranked.iter().map(|(row, found)| (row.product.as_str(), *found)).collect();
    let product = |&k: &usize| {
        let (one, found) = (&ranking.list[k], names[k].1);
        let figures: Map<String, Value> = list
            .figures
            .iter()
            .zip(&found.figures)
            .map(|(key, figure)| (key.clone(), json!({"value": figure.value, "error": figure.error})))
            .collect();
        json!({
            "product": names[k].0,
            "figures": figures,
            "utility": one.utility.value,
            "utility_error": one.utility.error,
            "rank_first": one.ranks.first,
            "rank_last": one.ranks.last,
            "front": one.place.word(),
            "approximate": found.approximate,
            "why": why(list, &ranking.list, &names, k),
            "to_best": one.to_best.as_ref().map(|(other, why)| {
                let mut parts = parts(list, found, why);
                parts["product"] = json!(names[*other].0);
                parts
            }),
            "to_mean": parts(list, found, &one.to_mean),
        })
    };
    let excluded: Vec<Value> =
        list.excluded().into_iter().map(|(row, reason)| json!({"product": row.product, "reason": reason})).collect();
    json!({
        "scene": list.scene,
        "climate": list.climate,
        "azimuth": list.azimuth,
        "objectives": list.figures.iter().zip(&list.objectives).map(objective).collect::<Vec<_>>(),
        "products": ranking.order.iter().map(product).collect::<Vec<_>>(),
        "excluded": excluded,
    })
}

fn objective((figure, one): (&String, &Objective)) -> Value {
    let better = if one.better == Better::Less { "less" } else { "more" };
    json!({"figure": figure, "better": better, "worst": one.worst, "best": one.best, "weight": one.weight})
}

/// Returns a difference of scores as JSON. The scores of its shares add up to it; parts and rest of a share add up to
/// the difference of the share's figure.
fn parts(list: &List, own: &Found, why: &Why) -> Value {
    let shares: Vec<Value> = why
        .shares
        .iter()
        .enumerate()
        .map(|(k, share)| {
            let groups: Vec<Value> = share
                .parts
                .iter()
                .enumerate()
                .map(|(part, value)| {
                    let [season, sun, zone] = own.parts[k].name(part);
                    json!({"season": season, "sun": sun, "zone": zone, "figure": value})
                })
                .collect();
            json!({
                "figure": list.figures[k],
                "utility": share.utility,
                "difference": share.figure,
                "parts": groups,
                "rest": share.rest,
            })
        })
        .collect();
    json!({"utility": why.utility, "shares": shares})
}
