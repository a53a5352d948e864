//! `cfs lid`: the luminous-intensity distribution of an aperture as a luminaire file, table or diagram.

use super::lid_summary::{report, summary};
use super::output::print;
use super::progress::TerminalProgress;
use super::weather_info::weather_notes;
use super::writing::{Over, StreamFormat, Tables, refuse_stream, report_written};
use crate::compute::lid::c_gamma::{Aim, Step};
use crate::formats::ies::IesEdition;
use crate::formats::luminaire_index::{self, Row};
use crate::formats::{FileKind, LuminaireFormat};
use crate::study::luminaire_file::{LidFormat, describe};
use crate::study::luminaire_series::{Member, Series};
use crate::study::luminaire_set::{LuminaireOptions, SetError, TileFile, Tiles, make, tile_name};
use crate::study::{Scene, Session, clock, files, read_scene_file, system::SystemLibrary};
use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Arguments of `cfs lid`.
#[derive(Debug, Clone, Args)]
#[command(after_help = "\
Examples:
  cfs lid office.toml --out office.ldt
                           write one luminaire file
  cfs lid sunny.toml --tiles 4x2 --without-beam --out sunny.ies
                           write eight luminaires and an index
  cfs lid blind.toml --months 6,12 --hours 9,12 --states 0,45 --out blind.ldt
                           write a series of eight files and an index

With --tiles, the files are NAME_1.ldt, NAME_2.ldt and so on, row by row from the lower left seen from outside. The \
files of a series have date, time and state in their names. Both have an index, NAME.index.csv, which a scene can \
use as a system: { luminaires = \"NAME.index.csv\" }. Both are for .ldt and .ies only.

A series over months or hours takes the year, and whatever is not varied, from sky.time; it needs latitude, \
longitude and utc_offset. Times with the sun below the horizon are left out, with a note.

The direct sun that --without-beam leaves out is stated in the files, in the index and in the summary.

Columns of the index:
  file           luminaire file, relative to the index
  x,y,z          centre of the luminous area in room axes [m]
  width,height   size along x, and along z (façade) or y (roof) [m]
  flux_lm        luminous flux of the file [lm]
  surface        facade or roof
  aim            mounted or down, see --aim
  beam_lm        part of flux_lm that leaves in beams of the sun [lm]
  apart_lm       flux of the direct sun left out by --without-beam [lm]
  apart_x,apart_y,apart_z
                 its direction, away from the sun, in room axes
  apart_lx       its illuminance on a plane perpendicular to it [lx]
  set            member of a series: date, time and state")]
pub struct LidArgs {
    /// Scene file (.toml)
    pub scene: PathBuf,
    /// Number of the aperture in the scene, from 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub aperture: u32,
    /// File to write: .ldt (EULUMDAT), .ies (LM-63), .csv (table), .png or .svg (polar diagram)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Option for the format of output to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Edition of LM-63 for .ies
    #[arg(long, value_enum, default_value_t = EditionArg::Y2002)]
    pub edition: EditionArg,
    /// Orientation of the aperture in the file (default: mounted for the façade, down for the roof)
    #[arg(long, value_enum)]
    pub aim: Option<AimArg>,
    /// Step of C and γ in degrees, a divisor of 90 from 1 to 15 (default: chosen from the data)
    #[arg(long, value_name = "DEGREES")]
    pub step: Option<f64>,
    /// Split the aperture into a grid of luminaires: none, auto (as few as light the room within 1 %), or columns and
    /// rows as in 8x8, at most 40x40
    #[arg(long, value_name = "TILES", default_value = "none")]
    pub tiles: Tiles,
    /// Leave out the direct sun that passes undeviated, for software that traces it through the aperture itself
    #[arg(long)]
    pub without_beam: bool,
    /// Write a series of files for the 21st of these months, 1 to 12, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub months: Vec<u8>,
    /// Write a series of files for these hours of local time, as in 9,12,15.5
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub hours: Vec<f64>,
    /// Write a series of files for these states of the system, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub states: Vec<String>,
    /// Print a summary as JSON
    #[arg(long)]
    pub json: bool,
}

/// Edition of IES LM-63 in which an .ies file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum EditionArg {
    /// LM-63-2002, the edition that most programs read
    #[value(name = "2002")]
    Y2002,
    /// LM-63-2019
    #[value(name = "2019")]
    Y2019,
}

/// Orientation of the aperture relative to the C planes of the luminaire file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AimArg {
    /// Façade as built: γ = 0° is downwards, C0 points into the room
    Mounted,
    /// Outward normal upwards, so that the light goes down; tilt a façade by 90° in the other program
    Down,
}

/// Runs `cfs lid`.
///
/// Options are checked before anything is computed; either all files are written or none.
pub fn run(args: &LidArgs, library: &dyn SystemLibrary) -> Result<()> {
    let options = luminaire_options(args)?;
    let path = &args.scene;
    let keys = read_scene_file(path)?;
    let (index, count) = (args.aperture as usize - 1, keys.aperture.len());
    if count == 0 {
        bail!("{}: aperture: the scene needs at least one [[aperture]]", path.display());
    }
    if index >= count {
        bail!("{}: --aperture {}: the scene has apertures 1 to {count}", path.display(), index + 1);
    }
    let series = Series { months: args.months.clone(), hours: args.hours.clone(), states: args.states.clone() };
    let base = files::folder(path);
    let (members, dark) = if series.is_empty() {
        (vec![Member { name: String::new(), tag: String::new(), scene: keys }], Vec::new())
    } else {
        series.members(&keys, base, index).with_context(|| path.display().to_string())?
    };
    for time in &dark {
        report!("note: {time} is skipped: the sun is below the horizon");
    }
    let kind = options.format.kind();
    args.tables.check([&**path], None, kind, true)?;
    if needs_index(&options, &members) {
        refuse_stream(&args.out)?;
        if args.out.file_name().is_none_or(|name| name.to_str().is_none()) {
            bail!(
                "--out {}: a name that is not UTF-8, in which the index names files; expected another",
                args.out.display()
            );
        }
        args.tables.over.check([], Some(&args.out.with_extension("index.csv")), FileKind::Csv)?;
    } else {
        args.tables.over.check([], Some(&args.out), kind)?;
    }
    let mut written = Written { over: args.tables.over, kind, paths: Vec::new(), new: Vec::new(), index: None };
    let made = all(args, &options, &members, library, &mut written);
    if made.is_ok() {
        report_written(written.paths.iter().map(PathBuf::as_path));
    }
    match made {
        Ok(summaries) if args.json => {
            let index = written.index.map(|path| path.to_string_lossy().into_owned());
            let summary = match <[serde_json::Value; 1]>::try_from(summaries) {
                Ok([only]) if series.is_empty() => only,
                Ok(only) => serde_json::json!({ "index": index, "left_out": dark, "members": only }),
                Err(many) => serde_json::json!({ "index": index, "left_out": dark, "members": many }),
            };
            print(&format!("{summary:#}\n"))
        }
        Ok(_) => Ok(()),
        Err(error) => {
            written.undo();
            Err(error)
        }
    }
}

/// Files that a run of `cfs lid` has written so far, to be removed after an error.
struct Written {
    over: Over,
    kind: FileKind,
    paths: Vec<PathBuf>,
    new: Vec<PathBuf>,
    index: Option<PathBuf>,
}

impl Written {
    /// Writes files: all of them, or none after an error.
    fn put(&mut self, list: &[(PathBuf, FileKind, &[u8])]) -> Result<()> {
        let new: Vec<_> = list.iter().filter(|(path, ..)| !path.exists()).map(|(path, ..)| path.clone()).collect();
        self.over
            .write_silently(&list.iter().map(|(path, kind, bytes)| (&**path, *kind, *bytes)).collect::<Vec<_>>())?;
        self.paths.extend(list.iter().map(|(path, ..)| path.clone()));
        self.new.extend(new);
        Ok(())
    }

    /// Removes the new files after an error. Files that cannot be removed stay, without a report.
    fn undo(self) {
        for path in self.new {
            drop(std::fs::remove_file(path));
        }
    }
}

/// Whether the luminaire files need an index of their positions, which a single file does not.
fn needs_index(options: &LuminaireOptions, members: &[Member]) -> bool {
    options.tiles != Tiles::None || members.iter().any(|member| !member.name.is_empty())
}

/// Computes and writes the luminaire files of all members of a series, or of the scene alone. Returns a summary of each
/// as JSON.
fn all(
    args: &LidArgs,
    options: &LuminaireOptions,
    members: &[Member],
    library: &dyn SystemLibrary,
    written: &mut Written,
) -> Result<Vec<serde_json::Value>> {
    let (session, progress) = (Session::new(), TerminalProgress::new());
    let (path, index) = (&args.scene, args.aperture as usize - 1);
    let scene_name = path.file_name().unwrap_or_default().to_string_lossy();
    let date = clock::now().date().to_string();
    let base = files::folder(path);
    let (mut rows, mut summaries): (Vec<Row>, Vec<_>) = (Vec::new(), Vec::with_capacity(members.len()));
    for member in members {
        let about = || {
            if member.name.is_empty() {
                path.display().to_string()
            } else {
                format!("{}, {}", path.display(), member.name)
            }
        };
        let scene = Scene::resolve(&member.scene, base, library).with_context(about)?;
        if let Some(note) = scene.illuminances.and_then(|light| light.note()) {
            report!("note: {note}");
        }
        weather_notes(scene.weather.as_ref());
        let text = describe(&scene_name, &member.scene, base, index, &date);
        let name = |tile: Option<usize>| file_name(&args.out, &member.tag, tile);
        let set = make(&session, &scene, index, &text, options, name, &progress).map_err(|error| match error {
            SetError::Study(error) => anyhow::Error::from(error).context(about()),
            SetError::File(error) => anyhow::Error::from(error).context(args.out.display().to_string()),
        })?;
        // A single file has the name of `--out`, which need not be UTF-8.
        let named = needs_index(options, members);
        let target = |file: &TileFile| {
            if named { args.out.with_file_name(&file.row.file) } else { args.out.clone() }
        };
        let bytes = |file: &TileFile| match std::str::from_utf8(&file.bytes) {
            Ok(table) if written.kind == FileKind::Csv => args.tables.bytes(table),
            _ => file.bytes.clone(),
        };
        let made: Vec<_> = set.files.iter().map(|file| (target(file), bytes(file))).collect();
        let list: Vec<_> = made.iter().map(|(path, bytes)| (path.clone(), written.kind, &**bytes)).collect();
        written.put(&list)?;
        rows.extend(set.files.iter().map(|file| Row { set: member.name.clone(), ..file.row.clone() }));
        if !args.json {
            report(args.without_beam, &set, member);
        }
        summaries.push(summary(&args.out, args.aperture, &set, member));
    }
    if needs_index(options, members) {
        let path = args.out.with_extension("index.csv");
        written.put(&[(path.clone(), FileKind::Csv, &luminaire_index::write(&rows))])?;
        if !args.json {
            report!("index of {} files", rows.len());
        }
        written.index = Some(path);
    }
    Ok(summaries)
}

/// Returns the luminaire options of the arguments.
fn luminaire_options(args: &LidArgs) -> Result<LuminaireOptions> {
    let edition = match args.edition {
        EditionArg::Y2002 => IesEdition::Lm63_2002,
        EditionArg::Y2019 => IesEdition::Lm63_2019,
    };
    let shown = args.out.display();
    let mut format = LidFormat::of(&args.stream.name(&args.out)?).with_context(|| format!("--out {shown}"))?;
    if let LidFormat::Luminaire(LuminaireFormat::Ies(own)) = &mut format {
        *own = edition;
    }
    if !matches!(format, LidFormat::Luminaire(_)) {
        if args.tiles != Tiles::None {
            bail!("--tiles {}: {shown} is not a luminaire file (.ldt or .ies)", args.tiles);
        }
        if !(args.months.is_empty() && args.hours.is_empty() && args.states.is_empty()) {
            bail!("--months, --hours, --states: a series is of luminaire files (.ldt or .ies), not {shown}");
        }
    }
    let step = args.step.map(Step::from_degrees).transpose().context("--step")?;
    let aim = args.aim.map(|aim| match aim {
        AimArg::Mounted => Aim::Mounted,
        AimArg::Down => Aim::Down,
    });
    Ok(LuminaireOptions { format, aim, step, tiles: args.tiles, without_beam: args.without_beam })
}

/// Returns the name of a luminaire file: that of `out` with the tag of a member of a series and the number of a tile
/// added.
fn file_name(out: &Path, tag: &str, tile: Option<usize>) -> String {
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let tag = if tag.is_empty() { String::new() } else { format!("_{tag}") };
    tile_name(Path::new(&format!("{}{tag}.{}", part(out.file_stem()), part(out.extension()))), tile)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::{eulumdat, ies};
    use crate::study::Library;
    use clap::Parser;

    #[derive(Parser)]
    struct Command {
        #[command(flatten)]
        lid: LidArgs,
    }

    /// Writes a scene with a diffusing aperture of 2 m x 1 m in the façade or the roof. Returns its flux. \[lm\]
    fn scene(folder: &Path, surface: &str) -> f64 {
        let text = format!(
            "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\nreflectance = {{ floor = 0, walls = 0, ceiling = 0 }}\n\
             [[aperture]]\nsurface = \"{surface}\"\norigin = [1.0, 1.0]\nsize = [2.0, 1.0]\n\
             system = {{ ideal = \"diffuse\", transmittance = 0.5 }}\n[site]\nground_reflectance = 1.0\n\
             [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 10000.0\n\
             [sensors]\npoints = [[2.0, 2.0, 0.85]]\nnormal = [0.0, 0.0, 1.0]\n"
        );
        std::fs::write(folder.join("s.toml"), text).unwrap();
        0.5 * 10_000.0 * 2.0
    }

    fn run_on(folder: &Path, words: &[&str]) -> Result<()> {
        let scene = folder.join("s.toml").to_string_lossy().into_owned();
        let command = Command::try_parse_from(["lid", &scene].iter().chain(words))?;
        run(&command.lid, &Library::with_catalogue(Some(&folder.join("none.db"))))
    }

    #[test]
    fn extension_and_options_decide_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
        let flux = scene(folder.path(), "facade");
        run_on(folder.path(), &["--out", &path("a.ldt")]).unwrap();
        let mounted = eulumdat::read(&std::fs::read(path("a.ldt")).unwrap()).unwrap();
        assert!((mounted.flux_within(90.0) / flux - 0.5).abs() < 0.01);
        scene(folder.path(), "roof");
        run_on(folder.path(), &["--out", &path("b.ies"), "--edition", "2019"]).unwrap();
        let down = ies::read(&std::fs::read(path("b.ies")).unwrap()).unwrap();
        assert_eq!(down.format, "IES:LM-63-2019");
        assert!((down.flux_within(90.0) / flux - 1.0).abs() < 0.01);
        for name in ["c.csv", "d.png", "e.svg"] {
            run_on(folder.path(), &["--out", &path(name), "--step", "5", "--aim", "down"]).unwrap();
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 6);
    }

    #[test]
    fn tiles_are_a_file_each_and_an_index() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let flux = scene(folder.path(), "facade");
        let out = path("a.ies").to_string_lossy().into_owned();
        run_on(folder.path(), &["--out", &out, "--tiles", "2x1", "--step", "5"]).unwrap();
        let rows = luminaire_index::read(&std::fs::read(path("a.index.csv")).unwrap()).unwrap();
        assert_eq!(rows.iter().map(|row| row.file.as_str()).collect::<Vec<_>>(), ["a_1.ies", "a_2.ies"]);
        for (row, x) in rows.iter().zip([1.5, 2.5]) {
            assert_eq!((row.centre.to_array(), row.size), ([x, 0.0, 1.5], [1.0, 1.0]));
            let file = ies::read(&std::fs::read(path(&row.file)).unwrap()).unwrap();
            assert!((file.flux() / (0.5 * flux) - 1.0).abs() < 1e-3 && (row.flux / file.flux() - 1.0).abs() < 1e-4);
            assert_eq!((file.opening.along_c90, file.opening.height), (1.0, 1.0));
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
    }

    #[test]
    fn a_series_has_one_index_whose_sets_light_rooms() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        scene(folder.path(), "facade");
        let text = std::fs::read_to_string(path("s.toml")).unwrap();
        let text = text.replace("[site]\n", "[site]\nlatitude = 48.8\nlongitude = 9.2\nutc_offset = 1.0\n");
        let text = text.replace("[sky]\n", "[sky]\ntime = \"2026-03-21T12:00\"\n");
        std::fs::write(path("s.toml"), &text).unwrap();
        let out = path("a.ldt").to_string_lossy().into_owned();
        let series = ["--months", "6,12", "--hours", "5.5,12", "--tiles", "2x1", "--step", "5"];
        run_on(folder.path(), &[["--out", &out].as_slice(), &series].concat()).unwrap();
        let rows = luminaire_index::read(&std::fs::read(path("a.index.csv")).unwrap()).unwrap();
        let sets = crate::study::luminaires::sets(&rows);
        // In December the sun is not up at half past five.
        assert_eq!(sets, ["2026-06-21T05:30", "2026-06-21T12:00", "2026-12-21T12:00"]);
        assert_eq!((rows.len(), rows[1].file.as_str()), (6, "a_06-21T0530_2.ldt"));
        let header = eulumdat::read(&std::fs::read(path(&rows[5].file)).unwrap()).unwrap().text;
        for gist in ["48.8N 9.2E", "2026-12-21T12:00", "sun 17."] {
            assert!(header.number.contains(gist), "{}", header.number);
        }
        // A scene names the set that lights it.
        let lit = |set: &str| {
            let system = "system = { ideal = \"diffuse\", transmittance = 0.5 }";
            let text = text.replace(system, &format!("system = {{ luminaires = \"a.index.csv\"{set} }}"));
            let keys = crate::study::SceneFile::parse(&text).unwrap();
            Scene::resolve(&keys, folder.path(), &Library::default())
        };
        let room =
            Session::new().room(&lit(", set = \"2026-12-21T12:00\"").unwrap(), &TerminalProgress::new()).unwrap();
        let own = Session::new().room(&load(folder.path()), &TerminalProgress::new()).unwrap();
        let [got, wanted] = [&room, &own].map(|room| room.sensors[0].total().value);
        // Two tiles of a metre, as a host cuts them.
        assert!((got / wanted - 1.0).abs() < 0.03, "{got} {wanted}");
        for (set, gist) in [("", "a series of 3"), (", set = \"noon\"", "no set \"noon\"")] {
            let error = lit(set).unwrap_err().to_string();
            assert!(error.contains(gist) && error.contains("2026-12-21T12:00"), "{error}");
        }
    }

    fn load(folder: &Path) -> Scene {
        crate::study::load_scene(&folder.join("s.toml"), &Library::default()).unwrap()
    }

    #[test]
    fn wrong_options_are_told_and_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        scene(folder.path(), "facade");
        let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
        let refused = |words: &[&str], gist: &[&str]| {
            let error = format!("{:#}", run_on(folder.path(), words).unwrap_err());
            assert!(gist.iter().all(|gist| error.contains(gist)), "{error}");
        };
        refused(&["--out", &path("a.xyz")], &["xyz", "ldt, ies, csv"]);
        refused(&["--out", &path("a.ldt"), "--step", "7"], &["does not divide 90"]);
        refused(&["--out", &path("a.ldt"), "--aperture", "0"], &["0"]);
        refused(&["--out", &path("a.ldt"), "--aperture", "2"], &["--aperture 2", "1 to 1"]);
        refused(&["--out", &path("a.ldt"), "--tiles", "0x4"], &["0x4", "auto, none"]);
        refused(&["--out", &path("a.svg"), "--tiles", "2x2"], &["--tiles 2x2", ".ldt or .ies"]);
        refused(&["--out", &path("a.csv"), "--hours", "9"], &["series", "a.csv"]);
        refused(&["--out", "/nonexistent/a.ldt"], &["/nonexistent"]);
        // The second file of three cannot be written: the first one goes again.
        std::fs::create_dir(path("b_2.ies")).unwrap();
        refused(&["--out", &path("b.ies"), "--tiles", "3x1", "--step", "5"], &["b_2.ies"]);
        let left: Vec<_> = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(left.len(), 2, "{left:?}");
    }
}
