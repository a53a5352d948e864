//! Weather of a place, interval by interval: content of a weather file, position of the sun, and illuminances.
//!
//! | file | content |
//! | --- | --- |
//! | `calendar` | days of the civil calendar, the earth's distance from the sun |
//! | `record` | content of a file: station, records, their quantities |
//! | `weekdays` | days of the week, also of spliced years |
//! | `sun_path` | the sun's position at any minute of a day, fast |
//! | `hour` | a record with its sun in the lit part, irradiances and illuminances |
//! | `closure` | test of the file's clock |
//! | `contradictions` | irradiances, unit and clock that contradict each other or the place |
//! | `count` | rows with a finding in common |
//! | `examine` | gaps, missing values, light with the sun down, sums |
//!
//! Intervals are those of the file (an hour mostly), in local standard time all the year round. The sun of an interval
//! is at its position in the middle of the part in which its centre is above the horizon (true altitude, no
//! refraction); irradiances stay the means over the whole interval. The sun is never binned.

mod calendar;
mod closure;
mod contradictions;
mod count;
mod examine;
mod hour;
mod record;
mod sun_path;
mod weekdays;

pub use calendar::Day;
pub use closure::SEARCHED;
pub use examine::{Summary, Sums};
pub use hour::{Hour, HourError, Hours, LightSource, Reading, SunOffset, WIDEST_OFFSET};
pub use record::{Closure, Field, Quantity, Record, Station, Weather};
pub use sun_path::{SunPath, SunPathError};
