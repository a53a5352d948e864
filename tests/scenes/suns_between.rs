//! What described systems scatter of many suns is found between directions: held against the same suns found one by one.

use cfs::compute::angle::Bearing;
use cfs::compute::direction::Dir;
use cfs::compute::estimate::Silent;
use cfs::compute::sky::Sun;
use cfs::study::{Coefficients, Library, Scene, SceneFile, Session};

const ROOM: &str = "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\nreflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }\n\
    [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nreflectance = 0.1\n\
    system = { file = \"own.system.toml\" }\n\
    [site]\nazimuth = 180.0\nlatitude = 40.0\nlongitude = 0.0\nutc_offset = 0.0\nground_reflectance = 0.2\n\
    [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 10000.0\n\
    [sensors]\npoints = [[1.8, 0.6, 0.8], [2.6, 1.4, 0.8], [1.2, 2.6, 0.8], [2.0, 4.4, 0.8]]\n";
const LOBE: &str = "kind = \"diffuser\"\n[diffuser]\nmodel = \"spreading\"\nindex = 1.49\nregular = 0.1\nlobe = 0.7\nspread = 8.0\n\
    transmittance = 0.85\nabsorbed = 0.2\n";
const GRID: &str = "kind = \"perforated\"\n[perforated]\nhole = \"rectangle\"\nwidth = 0.0127\nheight = 0.0127\n\
    pitch = [0.014, 0.014]\nthickness = 0.0127\nreflectance = 0.8\n";
const BEHIND_GLASS: &str = "kind = \"stack\"\n[stack]\n\
    layers = [{ file = \"pane.system.toml\" }, { file = \"slats.system.toml\", state = \"30\" }]\n";
const PANE: &str = "name = \"Pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\n\
    transmittance_normal = 0.9\npanes = 2\n";
const SLATS: &str = "name = \"Slats\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [30.0]\n\
    upper = { reflectance = 0.6 }\nlower = { reflectance = 0.5 }\n";

#[test]
fn suns_between_directions_are_those_found_alone() {
    for (name, description) in [("lobe", LOBE), ("grid", GRID), ("behind glass", BEHIND_GLASS)] {
        let folder = tempfile::tempdir().unwrap();
        for (file, text) in
            [("own", format!("name = \"Own\"\n{description}")), ("pane", PANE.to_owned()), ("slats", SLATS.to_owned())]
        {
            std::fs::write(folder.path().join(format!("{file}.system.toml")), text).unwrap();
        }
        let library = Library::default();
        let scene = Scene::resolve(&SceneFile::parse(ROOM).unwrap(), folder.path(), &library).unwrap();
        let session = Session::new();
        let prepared = |suns: usize| {
            let mut prepared = Coefficients::new(&session, &scene, &Silent).unwrap();
            prepared.keep_year(&session, (1, 1), suns);
            prepared
        };
        let (few, many) = (prepared(1), prepared(100_000));
        let (mut squares, mut count, mut apart) = (0.0, 0.0, 0);
        for k in 0..30 {
            // All over the quarter of the sky before the façade, nowhere on a node.
            let [a, b] = [0.618_034, 0.754_878].map(|step: f64| (0.31 + step * f64::from(k)).fract());
            let direction = Dir::from_altitude_bearing(0.1 + 1.1 * a, Bearing::from_degrees(105.0 + 150.0 * b));
            let sun = Sun { direction, direct_normal: 8e4 };
            let (alone, between) = (few.sun_estimate(&sun), many.sun_estimate(&sun));
            let mean = alone.iter().map(|e| e.value).sum::<f64>() / alone.len() as f64;
            assert!(mean > 10.0, "{name}: {mean} lx");
            for (one, other) in alone.iter().zip(&between) {
                let off = (one.value - other.value).abs();
                assert!(off <= one.error + other.error, "{name}: {one:?} {other:?}");
                squares += (off / one.value.max(0.1 * mean)).powi(2);
                count += 1.0;
                apart += usize::from(off > 0.0);
            }
        }
        let rms = f64::sqrt(squares / count);
        println!("{name}: {rms:.1e} rms");
        assert!(rms < 5e-3, "{name}: {rms}");
        assert!(apart > 60, "{name}: both were found the same way");
    }
}
