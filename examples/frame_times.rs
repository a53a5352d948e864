//! Measures the time per frame of the window, without a display: six tiles at 1280 × 720 with results of the real
//! engine.
//!
//! `cargo run --release --example frame_times [FRAMES] [CATALOGUE]`
//!
//! By default 240 frames and the built-in products; `large_catalogue` writes larger catalogues. Look at the median
//! times: those of this program on the drawing thread while the sun is dragged, in total and per tile; those of egui
//! for tessellation; then scrolling of the product list, and the time from a letter in the search field to its
//! result.

use cfs::app::App;
use cfs::app::catalogue::shelf::Shelf;
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, memory_shelf, open_shelf};
use cfs::app::scene::moment;
use cfs::app::shell::error::AppError;
use egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, RawInput, Rect, TouchPhase, pos2, vec2,
};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Maximum waiting time for results.
const TIMEOUT: Duration = Duration::from_secs(600);
/// Step of the clock from one frame to the next. \[min\]
const STEP: i32 = 1;

/// Window that is drawn frame by frame, without a display.
struct Window {
    ctx: egui::Context,
    app: App,
    time: f64,
}

/// Times and size of one frame.
struct Frame {
    logic: Duration,
    draw: Duration,
    tessellate: Duration,
    triangles: usize,
}

impl Window {
    fn frame(&mut self, events: Vec<Event>) -> Frame {
        self.time += 1.0 / 60.0;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 720.0))),
            time: Some(self.time),
            events,
            ..RawInput::default()
        };
        let (mut logic, mut draw) = (Duration::ZERO, Duration::ZERO);
        let app = &mut self.app;
        let output = self.ctx.run_ui(input, |ui| {
            let start = Instant::now();
            app.logic(&ui.ctx().clone());
            logic += start.elapsed();
            let start = Instant::now();
            app.draw(ui);
            draw += start.elapsed();
        });
        let start = Instant::now();
        let list = self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let tessellate = start.elapsed();
        let triangles = list
            .iter()
            .map(|one| match &one.primitive {
                egui::epaint::Primitive::Mesh(mesh) => mesh.indices.len() / 3,
                egui::epaint::Primitive::Callback(_) => 0,
            })
            .sum();
        Frame { logic, draw, tessellate, triangles }
    }

    fn settle(&mut self) -> anyhow::Result<()> {
        let start = Instant::now();
        loop {
            self.frame(vec![]);
            let there = self.app.shell.results.room.value.is_some() && self.app.shell.results.lid.value.is_some();
            if there && !self.app.busy() {
                return Ok(());
            }
            anyhow::ensure!(start.elapsed() < TIMEOUT, "no results within {TIMEOUT:?}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Opens the catalogue named as the second argument, or a new one in memory.
fn shelf() -> Result<Arc<dyn Shelf>, AppError> {
    std::env::args_os().nth(2).map_or_else(memory_shelf, |path| open_shelf(Some(Path::new(&path))))
}

/// Scrolls the list of products for `frames` frames; returns the time of this program per frame.
fn scroll(window: &mut Window, frames: usize) -> Vec<Duration> {
    let over = pos2(120.0, 400.0);
    window.frame(vec![Event::PointerMoved(over)]);
    let wheel = |delta| Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, delta),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    };
    let mut ours = Vec::new();
    for number in 0..frames {
        // Down the list and back.
        let down = number < frames / 2;
        let frame = window.frame(vec![wheel(if down { -400.0 } else { 400.0 })]);
        ours.push(frame.logic + frame.draw);
        std::thread::sleep(Duration::from_millis(8));
    }
    ours
}

/// Types a word into the search field; returns the time from each letter to its result.
fn search(window: &mut Window) -> anyhow::Result<Vec<Duration>> {
    let key =
        |pressed| Event::Key { key: Key::F, physical_key: None, pressed, repeat: false, modifiers: Modifiers::COMMAND };
    window.frame(vec![key(true)]);
    window.frame(vec![key(false)]);
    let mut times = Vec::new();
    for letter in "venetian".chars() {
        let before = window.app.shell.state.found.clone();
        let start = Instant::now();
        window.frame(vec![Event::Text(letter.to_string())]);
        while Arc::ptr_eq(&before, &window.app.shell.state.found) {
            anyhow::ensure!(start.elapsed() < TIMEOUT, "no answer to a letter within {TIMEOUT:?}");
            std::thread::sleep(Duration::from_millis(1));
            window.frame(vec![]);
        }
        times.push(start.elapsed());
    }
    Ok(times)
}

fn milliseconds(mut list: Vec<Duration>) -> String {
    list.sort_unstable();
    let at = |share: f64| list.get(((list.len() as f64 * share) as usize).min(list.len().saturating_sub(1)));
    let quantile = |share| at(share).map_or(0.0, |time| 1e3 * time.as_secs_f64());
    format!("median {:6.2}   nine tenths {:6.2}   longest {:6.2}", quantile(0.5), quantile(0.9), quantile(1.0))
}

fn main() -> anyhow::Result<()> {
    let frames: usize = std::env::args().nth(1).map_or(Ok(240), |text| text.parse())?;
    let engine = Arc::new(StudyEngine::default());
    let mut window = Window { ctx: egui::Context::default(), app: App::with_shelf(engine, shelf), time: 0.0 };
    window.settle()?;
    let at = pos2(1276.0, 716.0);
    let press =
        Event::PointerButton { pos: at, button: PointerButton::Primary, pressed: true, modifiers: Modifiers::NONE };
    window.frame(vec![Event::PointerMoved(at), press]);
    let (mut logic, mut draw, mut tessellate, mut ours) = (vec![], vec![], vec![], vec![]);
    let mut tiles: BTreeMap<&'static str, Vec<Duration>> = BTreeMap::new();
    let (mut triangles, mut moved) = (0, window.app.shell.results.lid.revision);
    let mut results = 0;
    for _ in 0..frames {
        let mut scene = window.app.shell.state.document.scene.clone();
        moment::step(&mut scene, 0, STEP);
        window.app.apply(Command::Scene(Box::new(scene)));
        let frame = window.frame(vec![]);
        ours.push(frame.logic + frame.draw);
        logic.push(frame.logic);
        draw.push(frame.draw);
        tessellate.push(frame.tessellate);
        triangles = frame.triangles;
        for (tile, time) in window.app.tile_times() {
            tiles.entry(tile.title).or_default().push(*time);
        }
        results += u64::from(moved != window.app.shell.results.lid.revision);
        moved = window.app.shell.results.lid.revision;
        // Leaves other threads time to work, as a display with 60 frames per second does.
        std::thread::sleep(Duration::from_millis(8));
    }
    println!("{frames} frames, {results} new light distributions, {triangles} triangles; milliseconds:");
    println!("our code       {}", milliseconds(ours));
    println!("  logic        {}", milliseconds(logic));
    println!("  drawing      {}", milliseconds(draw));
    for (title, times) in tiles {
        println!("    {title:<13}{}", milliseconds(times));
    }
    println!("tessellation   {}", milliseconds(tessellate));
    let release =
        Event::PointerButton { pos: at, button: PointerButton::Primary, pressed: false, modifiers: Modifiers::NONE };
    window.frame(vec![release]);
    window.settle()?;
    println!("scrolling      {}", milliseconds(scroll(&mut window, frames)));
    println!("a letter       {}", milliseconds(search(&mut window)?));
    println!("products       {} found", window.app.shell.state.found.entries.len());
    Ok(())
}
