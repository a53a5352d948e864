//! Steps by hand: what closes at once, what waits, what each threshold does.

use super::*;
use crate::compute::system::slats::SlatProfile;

fn degrees(list: impl IntoIterator<Item = i32>) -> Vec<f64> {
    list.into_iter().map(|value| f64::from(value).to_radians()).collect()
}

fn blind() -> SlatRow {
    SlatRow::new(SlatProfile::Flat { width: 0.080 }, 0.072).unwrap()
}

fn sun(psi: f64) -> Inputs {
    let centre = psi.to_radians();
    let span = [centre - 0.00465, centre + 0.00465];
    Inputs {
        hour: 12.0,
        of_year: None,
        day: true,
        sun: Some(SunAt { centre, span }),
        facade_direct: 50_000.0,
        facade_global: 60_000.0,
        indoor: None,
    }
}

fn cut_off() -> Settings {
    let rule = Rule::CutOff { section: blind(), tolerance: 0.0 };
    Settings::new(degrees((0..=15).map(|k| 5 * k)), rule).unwrap()
}

fn tilt(decision: Decision) -> i32 {
    5 * decision.state as i32
}

#[test]
fn the_sun_is_kept_out_at_every_step_however_it_moves() {
    let settings = Settings { hysteresis: 3_f64.to_radians(), dwell: 1200.0, ..cut_off() };
    let section = blind();
    let mut controller = Controller::new(settings.clone());
    let mut opened = 0;
    for k in 0..2000 {
        // A restless sun between 5° and 55°.
        let psi = 30.0 + 25.0 * (0.07 * f64::from(k)).sin() * (0.0013 * f64::from(k)).cos();
        let inputs = sun(psi);
        let decision = controller.step(60.0 * f64::from(k), &inputs);
        let value = settings.values[decision.state];
        assert!(section.blocks(value, 0.0, inputs.sun.unwrap().span), "{psi}");
        let free = cut_off_state(&section, &settings.values, 0.0, inputs.sun.unwrap().span);
        assert!(decision.state >= free);
        opened += usize::from(decision.moved);
    }
    assert!(opened > 10);
}

#[test]
fn opening_waits_and_closing_does_not() {
    let mut controller = Controller::new(Settings { dwell: 600.0, ..cut_off() });
    assert_eq!(tilt(controller.step(0.0, &sun(20.0))), 40);
    // Lower sun: closed further at once.
    let closed = controller.step(10.0, &sun(10.0));
    assert!(closed.moved && tilt(closed) == 55, "{closed:?}");
    // Higher again: not before ten minutes are over.
    let held = controller.step(300.0, &sun(20.0));
    assert!(held.held && !held.moved && tilt(held) == 55);
    assert_eq!(tilt(controller.step(611.0, &sun(20.0))), 40);
}

#[test]
fn hysteresis_opens_only_when_it_is_worth_it() {
    let rule = Settings { hysteresis: 4_f64.to_radians(), ..cut_off() };
    // Demanded 37.8° + disc at ψ = 20°; 34.2° at 22.3°: within 4° of 35°, but 40 − 34.5 is more than …
    let mut controller = Controller::new(rule);
    assert_eq!(tilt(controller.step(0.0, &sun(20.0))), 40);
    let waiting = controller.step(60.0, &sun(22.3));
    assert!(waiting.held && tilt(waiting) == 40, "{waiting:?}");
    // 31° + 4° is still 35°: open by one state.
    assert_eq!(tilt(controller.step(120.0, &sun(25.0))), 35);
}

#[test]
fn demanded_values_are_those_of_the_closed_form() {
    let psi = 20_f64.to_radians() - 0.00465;
    let decision = Controller::new(cut_off()).step(0.0, &sun(20.0));
    let exact = (0.9 * psi.cos()).asin() - psi;
    assert!((decision.demanded.unwrap() - exact).abs() < 1e-12 && decision.reason == Reason::Sun);
}

#[test]
fn din_5034_closes_above_its_threshold_and_lets_go_below_its_release() {
    let values = degrees([0, 45, 75]);
    let settings = Settings { threshold: 10_000.0, release: 0.5, ..Settings::new(values, Rule::Din5034).unwrap() };
    let mut controller = Controller::new(settings);
    let mut at = |lux: f64| controller.step(0.0, &Inputs { facade_direct: lux, ..sun(30.0) }).state;
    assert_eq!([at(9000.0), at(11_000.0), at(9000.0), at(4000.0), at(9000.0)], [0, 2, 2, 0, 0]);
}

#[test]
fn bright_facades_close_and_dark_rooms_open_again() {
    let settings = Settings { close_above: Some(70_000.0), open_below: Some(300.0), ..cut_off() };
    let mut controller = Controller::new(settings);
    let mut at = |global: f64, indoor: Option<f64>| {
        let decision = controller.step(0.0, &Inputs { facade_global: global, indoor, ..sun(40.0) });
        (tilt(decision), decision.reason)
    };
    let rule = at(60_000.0, None);
    assert_eq!(rule, (5, Reason::Sun));
    assert_eq!(at(80_000.0, None), (75, Reason::Bright));
    assert_eq!(at(80_000.0, Some(500.0)), (75, Reason::Bright));
    // The room is dark: back to what the rule needs, and no further while the sun is there.
    assert_eq!(at(80_000.0, Some(200.0)), rule);
    // DIN 5034 closes all the way; a dark room takes that back.
    let settings = Settings { open_below: Some(300.0), ..Settings::new(degrees([0, 75]), Rule::Din5034).unwrap() };
    let mut din = Controller::new(settings);
    assert_eq!(din.step(0.0, &sun(40.0)).state, 1);
    let dark = din.step(60.0, &Inputs { indoor: Some(100.0), ..sun(40.0) });
    assert_eq!((dark.state, dark.reason), (0, Reason::Dark));
}

#[test]
fn nights_and_cloudy_days_have_their_own_states() {
    let settings = Settings { night: 15, open: 2, ..cut_off() };
    let mut controller = Controller::new(settings);
    let dark = Inputs { day: false, sun: None, facade_direct: 0.0, ..sun(0.0) };
    let night = controller.step(0.0, &dark);
    assert_eq!((night.state, night.reason, night.demanded), (15, Reason::Night, None));
    let cloudy = controller.step(60.0, &Inputs { day: true, ..dark });
    assert_eq!((cloudy.state, cloudy.reason), (2, Reason::NoSun));
}

#[test]
fn users_keep_their_hours() {
    let period = |from, to, state| Period { from, to, state };
    let rule = Rule::User(0, vec![period(8.0, 12.0, 1), period(22.0, 6.0, 2)]);
    let mut controller = Controller::new(Settings::new(degrees([0, 45, 75]), rule).unwrap());
    let mut at = |hour: f64| controller.step(0.0, &Inputs { hour, ..sun(30.0) }).state;
    assert_eq!([7.0, 8.0, 11.9, 12.0, 22.0, 3.0, 6.0].map(&mut at), [0, 1, 1, 0, 2, 2, 0]);
}

#[test]
fn mirror_slats_follow_the_sun_both_ways() {
    let values = degrees((-9..=18).map(|k| 5 * k));
    let value = |rule: Rule, psi: f64| {
        let mut controller = Controller::new(Settings::new(values.clone(), rule).unwrap());
        let state = controller.step(0.0, &sun(psi)).state;
        values[state].to_degrees().round()
    };
    // 90° − ψ, never less; ½(30° − ψ), the nearest.
    assert_eq!(value(Rule::RetroReflect(Rounding::Closed), 32.0), 60.0);
    assert_eq!(value(Rule::RetroReflect(Rounding::Nearest), 36.0), 55.0);
    assert_eq!(value(Rule::Redirect(30_f64.to_radians(), Rounding::Nearest), 52.0), -10.0);
    // Hysteresis keeps the nearest state a little longer.
    let rule = Rule::Redirect(30_f64.to_radians(), Rounding::Nearest);
    let settings = Settings { hysteresis: 2_f64.to_radians(), ..Settings::new(values.clone(), rule).unwrap() };
    let mut controller = Controller::new(settings);
    let first = controller.step(0.0, &sun(50.0)).state;
    assert_eq!(controller.step(1.0, &sun(56.0)).state, first);
    assert_ne!(controller.step(2.0, &sun(58.0)).state, first);
}

#[test]
fn a_row_of_a_table_holds_until_the_next() {
    let rule = Rule::Table(vec![(100.0, 2), (200.0, 0), (300.0, 1)]);
    let mut controller = Controller::new(Settings::new(degrees([0, 45, 75]), rule).unwrap());
    let mut at = |of_year: f64| controller.step(0.0, &Inputs { of_year: Some(of_year), ..sun(30.0) });
    assert_eq!([50.0, 100.0, 199.0, 200.0, 299.0, 300.0, 1e9].map(|time| at(time).state), [2, 2, 2, 0, 0, 1, 1]);
    assert_eq!(at(400.0).reason, Reason::Schedule);
}
