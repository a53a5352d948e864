//! Test of a weather file's clock: global = diffuse + direct · sin h closes where the sun is in the right position.

use super::record::{Closure, Quantity, Weather};
use super::sun_path::{SunPath, SunPathError};

/// Maximum clock offset, later and earlier, that the test of a weather file's clock tries. \[min\] Chosen: of nine
/// measured and modelled years three have a clock that is off, by 30 and 40 min; an hour of daylight saving time may be
/// added.
pub const SEARCHED: i32 = 120;
/// Step between the clock offsets that the test tries. \[min\] Chosen: half of the 20 min from which a clock is
/// reported as off.
const STEP: i32 = 10;
/// Minimum number of rows with sun for a test of the clock. Chosen; no test depends on its exact value.
const LEAST_HOURS: usize = 20;
/// Minimum direct normal irradiance of a row that the test uses: smaller values are lost in the rounding of the others.
/// \[W/m²\]
const LEAST_BEAM: f64 = 1.0;

impl Weather {
    /// Tests the file's clock: finds the clock offset with which global = diffuse + direct · sin h (h: altitude of the
    /// sun) holds best. `None` for files without global irradiance or with too few hours of sun.
    ///
    /// # Errors
    /// Returns an error if the sun's position cannot be computed.
    pub fn closure(&self) -> Result<Option<Closure>, SunPathError> {
        if self.quantity != Quantity::NormalIrradiance {
            return Ok(None);
        }
        let places = (2 * SEARCHED / STEP + 1) as usize;
        let mut squares = vec![0.0; places];
        let mut hours = 0;
        let mut path = SunPath::new(&self.station);
        for record in &self.records {
            let (Some(global), Some(diffuse), Some(direct)) = (record.global, record.diffuse, record.direct) else {
                continue;
            };
            if direct < LEAST_BEAM {
                continue;
            }
            path.turn_to(record.day.number())?;
            hours += 1;
            for (place, sum) in squares.iter_mut().enumerate() {
                let offset = f64::from(STEP * place as i32 - SEARCHED);
                let sine = path.at(record.middle_minutes(self.interval, offset)).z.max(0.0);
                *sum += (global - diffuse - direct * sine).powi(2);
            }
        }
        if hours < LEAST_HOURS {
            return Ok(None);
        }
        let rms = |place: usize| (squares[place] / hours as f64).sqrt();
        let middle = places / 2;
        // Of equals the one nearest to the file's own clock.
        let best = (0..places)
            .min_by(|&a, &b| rms(a).total_cmp(&rms(b)).then(a.abs_diff(middle).cmp(&b.abs_diff(middle))))
            .unwrap_or(middle);
        let best_offset = f64::from(STEP * best as i32 - SEARCHED);
        Ok(Some(Closure { rms: rms(middle), best_offset, best_rms: rms(best) }))
    }
}
