//! A year of weather in the room: the map of its hours, its figures, the lamps, and the weather it is of.

texts! {
    const YEAR = "Year" | "Jahr";
    const YEAR_HELP = "Every hour of a year of weather in the room: light, glare, states, lighting energy. A click on an hour shows it in every tile." | "Jede Stunde eines Wetterjahrs im Raum: Licht, Blendung, Stellungen, Energie für Beleuchtung. Ein Klick auf eine Stunde zeigt sie in jeder Kachel.";
    const YEAR_ABOUT = "A year of weather in the room, hour by hour: sky by Perez, the sun where it is, the state that control picks, the light of that moment. Click an hour, or go by arrow keys, and every tile shows it. Figures carry what the errors of the hours leave open of them.\nSource: weather file; Perez et al. 1990, 1993; IEA SHC Task 31 report (2005), 4.2 and figure 18." | "Ein Wetterjahr im Raum, Stunde für Stunde: Himmel nach Perez, die Sonne, wo sie steht, die Stellung, die die Regelung wählt, das Licht des Augenblicks. Eine Stunde anklicken oder mit Pfeiltasten wählen: jede Kachel zeigt sie. Kennwerte tragen, was die Unsicherheiten der Stunden von ihnen offen lassen.\nQuelle: Wetterdatei; Perez et al. 1990, 1993; Bericht IEA SHC Task 31 (2005), 4.2 und Bild 18.";

    // Before there is one.
    const INVITATION = "How often is there enough light, how often too much, how often glare, and what do the lamps take? A year of weather in this room answers, hour by hour." | "Wie oft reicht das Licht, wie oft ist es zu viel, wie oft blendet es, und was brauchen die Lampen? Ein Wetterjahr in diesem Raum antwortet, Stunde für Stunde.";
    const COMPUTE = "Compute a year" | "Ein Jahr rechnen";
    const COMPUTE_TIP = "Goes on beside your work, and can be stopped" | "Läuft neben der Arbeit her und lässt sich anhalten";
    const COMPUTE_OFFER_TIP = "The present room through a year of weather; without one, that of the nearest place that comes with the program" | "Der gegenwärtige Raum durch ein Wetterjahr; ohne eines das des nächsten mitgelieferten Orts";
    const AGAIN = "Compute again" | "Neu rechnen";
    const AGAIN_TIP = "The scene has changed since this year was computed" | "Die Szene hat sich geändert, seit dieses Jahr gerechnet wurde";
    const STOP = "Stop" | "Anhalten";
    const STOP_TIP = "Stops computing the year; one that was there stays" | "Hält die Rechnung des Jahrs an; ein früheres bleibt";
    const LANE_ANNUAL = "year of weather" | "Wetterjahr";
    const LANE_WEATHER = "weather file" | "Wetterdatei";
    const STOPPED = "The year was stopped" | "Das Jahr wurde angehalten";
    const NO_YEAR = "there is no year yet; compute one in the Year tile first" | "es gibt noch kein Jahr; zuerst eines in der Kachel Jahr rechnen";
    const NO_YEAR_KEYS = "the scene has no [year]; give it weather = \"x.epw\"" | "die Szene hat kein [year]; es braucht weather = \"x.epw\"";
    const ADDED_EYE = "Lamps of 8 W/m² and an eye that looks at the façade were put into the scene; change them under Weather and year" | "Lampen mit 8 W/m² und ein Auge mit Blick zur Fassade wurden in die Szene gesetzt; unter Wetter und Jahr zu ändern";

    // Pages and choices.
    const PAGE_MAP = "Hours" | "Stunden";
    const PAGE_MAP_TIP = "A colour for every hour of the year" | "Eine Farbe für jede Stunde des Jahrs";
    const PAGE_FIGURES = "Figures" | "Kennwerte";
    const PAGE_FIGURES_TIP = "Daylight autonomy, useful illuminance, EN 17037, glare, lighting, with their errors" | "Tageslichtautonomie, nützliche Beleuchtungsstärke, EN 17037, Blendung, Beleuchtung, mit Unsicherheiten";
    const PAGE_LIGHTING = "Lamps" | "Lampen";
    const PAGE_LIGHTING_TIP = "Power of the lamps over a sunny day, and energy by month" | "Leistung der Lampen über einen sonnigen Tag und Energie je Monat";
    const QUANTITY = "What the map shows" | "Was die Karte zeigt";
    const QUANTITY_TIP = "Mean of the plane, a sensor, a state, glare at an eye, the lamps, or the light outside" | "Mittel der Ebene, ein Sensor, eine Stellung, Blendung an einem Auge, die Lampen oder das Licht draußen";
    const LOG = "log" | "log";
    const LOG_TIP = "Logarithmic colours, three decades" | "Logarithmische Farben, drei Dekaden";
    const MONTH = "Month of the sunny day" | "Monat des sonnigen Tags";
    const MONTH_TIP = "The day of the month with most direct light on which somebody is there is shown" | "Gezeigt wird der Tag des Monats mit dem meisten direkten Licht, an dem jemand da ist";
    fn scene_month(month) = "{month} (scene)" | "{month} (Szene)";

    // Maps.
    const MEAN = "Mean illuminance" | "Mittlere Beleuchtungsstärke";
    fn sensor(number) = "Sensor {number}" | "Sensor {number}";
    const STATE = "State" | "Stellung";
    fn dgps(eye) = "DGPs, eye {eye}" | "DGPs, Auge {eye}";
    const LIGHTING_POWER = "Lighting power" | "Leistung der Beleuchtung";
    const DIRECT_NORMAL = "Direct normal" | "Direkt normal";
    const DIFFUSE_HORIZONTAL = "Diffuse horizontal" | "Diffus horizontal";
    fn map_of(name) = "Hours of the year: {name}" | "Stunden des Jahrs: {name}";
    const NO_MARK = "no hour is marked; arrow keys begin in the middle of the year" | "keine Stunde ist markiert; Pfeiltasten beginnen in der Jahresmitte";
    fn cell_is(when, value) = "{when}: {value}" | "{when}: {value}";
    fn day_span(day, month, from, to) = "{day} {month}, {from}–{to}" | "{day}. {month}, {from}–{to}";
    const DARK = "dark" | "dunkel";
    const NOT_COMPUTED = "nothing known" | "nichts bekannt";
    fn summary(weather, lit, sets, seconds) = "{weather} · {lit} steps with light · sets of states: {sets} · {seconds} s" | "{weather} · {lit} helle Schritte · Sätze von Stellungen: {sets} · {seconds} s";
    fn other_state(year, now) = "the year has state {year} here, the moment alone {now} (hysteresis, dwell time)" | "das Jahr hat hier Stellung {year}, der Augenblick allein {now} (Hysterese, Haltezeit)";

    // Figures.
    const SECTION_LIGHT = "Light on the plane" | "Licht auf der Ebene";
    const SECTION_SUN = "Sun on the plane" | "Sonne auf der Ebene";
    const SECTION_PROVISION = "EN 17037, daylight provision" | "EN 17037, Tageslichtversorgung";
    const SECTION_GLARE = "Glare" | "Blendung";
    const SECTION_LIGHTING = "Lighting" | "Beleuchtung";
    const SECTION_CONTROL = "What moves" | "Was sich bewegt";
    const DA_300 = "DA, 300 lx" | "DA, 300 lx";
    const DA_500 = "DA, 500 lx" | "DA, 500 lx";
    const DA_TIP = "Daylight autonomy: share of the occupied hours in which daylight alone reaches this, mean of the sensors. Reinhart and Walkenhorst 2001." | "Tageslichtautonomie: Anteil der Nutzungszeit, in der Tageslicht allein dies erreicht, Mittel der Sensoren. Reinhart und Walkenhorst 2001.";
    const CDA_300 = "Continuous DA, 300 lx" | "Stetige DA, 300 lx";
    const CDA_TIP = "The same, where less light counts by its part. Rogers 2006." | "Dasselbe, wobei weniger Licht anteilig zählt. Rogers 2006.";
    const SDA = "sDA300/50%" | "sDA300/50%";
    const SDA_TIP = "Spatial daylight autonomy: share of the sensors with 300 lx in half of the occupied hours, with the states as they are; LM-83 works blinds by a rule of its own. IES LM-83-12." | "Räumliche Tageslichtautonomie: Anteil der Sensoren mit 300 lx in der halben Nutzungszeit, mit den Stellungen, wie sie sind; LM-83 bewegt Behänge nach eigener Regel. IES LM-83-12.";
    const SDA_LM83 = "sDA300/50%, blinds by LM-83" | "sDA300/50%, Behänge nach LM-83";
    const SDA_LM83_TIP = "Spatial daylight autonomy with blinds that close, group after group, while more than 2 % of the sensors have 1000 lx of direct sun. IES LM-83-12." | "Räumliche Tageslichtautonomie mit Behängen, die Gruppe um Gruppe schließen, solange mehr als 2 % der Sensoren 1000 lx Sonne haben. IES LM-83-12.";
    fn sda_limit(verdict) = "≥ 55 %: {verdict}" | "≥ 55 %: {verdict}";
    const UDI_N = "UDI, below 100 lx" | "UDI, unter 100 lx";
    const UDI_S = "UDI, 100 to 300 lx" | "UDI, 100 bis 300 lx";
    const UDI_A = "UDI, 300 to 3000 lx" | "UDI, 300 bis 3000 lx";
    const UDI_X = "UDI, above 3000 lx" | "UDI, über 3000 lx";
    const UDI_TIP = "Useful daylight illuminance: share of the occupied hours in this range; the four add up to 100 %. Mardaljevic et al. 2012." | "Nützliche Tageslichtbeleuchtungsstärke: Anteil der Nutzungszeit in diesem Bereich; die vier ergeben 100 %. Mardaljevic et al. 2012.";
    const ANNUAL_MEAN = "Mean of all hours" | "Mittel aller Stunden";
    const ANNUAL_MEAN_TIP = "Illuminance, mean of the sensors over all hours, nights included." | "Beleuchtungsstärke, Mittel der Sensoren über alle Stunden, auch nachts.";
    const ASE = "ASE1000,250" | "ASE1000,250";
    const ASE_TIP = "Annual sunlight exposure: share of the sensors with 1000 lx or more straight from the sun in more than 250 occupied hours. IES LM-83-12." | "Jährliche Besonnung: Anteil der Sensoren mit mindestens 1000 lx geradewegs von der Sonne in mehr als 250 Nutzungsstunden. IES LM-83-12.";
    fn ase_limit(verdict) = "≤ 10 %: {verdict}" | "≤ 10 %: {verdict}";
    const SUN_HOURS = "Hours with 1000 lx of sun" | "Stunden mit 1000 lx Sonne";
    const SUN_HOURS_TIP = "Occupied hours with 1000 lx or more straight from the sun, mean of the sensors." | "Nutzungsstunden mit mindestens 1000 lx geradewegs von der Sonne, Mittel der Sensoren.";
    const LEVEL_MINIMUM = "minimum" | "gering";
    const LEVEL_MEDIUM = "medium" | "mittel";
    const LEVEL_HIGH = "high" | "hoch";
    fn by_point(level, lux) = "{level}: area with {lux} lx" | "{level}: Fläche mit {lux} lx";
    const BY_POINT_TIP = "Share of the plane that reaches this in half of the daylight hours (the half of the year with most diffuse light). EN 17037:2018+A1:2021, method 2, read point by point." | "Anteil der Ebene, der dies in der Hälfte der Tageslichtstunden erreicht (der Jahreshälfte mit dem meisten diffusen Licht). EN 17037:2018+A1:2021, Verfahren 2, Punkt für Punkt gelesen.";
    fn by_hour(level, lux, area) = "{level}: time with {lux} lx on {area} %" | "{level}: Zeit mit {lux} lx auf {area} %";
    const BY_HOUR_TIP = "Share of the daylight hours in which so much of the plane reaches this. EN 17037:2018+A1:2021, method 2, read hour by hour." | "Anteil der Tageslichtstunden, in denen so viel der Ebene dies erreicht. EN 17037:2018+A1:2021, Verfahren 2, Stunde für Stunde gelesen.";
    fn at_least(percent, verdict) = "≥ {percent} %: {verdict}" | "≥ {percent} %: {verdict}";
    const MEDIAN_DIFFUSE = "Median of the diffuse light" | "Median des diffusen Lichts";
    const MEDIAN_DIFFUSE_TIP = "Diffuse horizontal illuminance outside in the daylight hours, median. EN 17037." | "Diffuse horizontale Beleuchtungsstärke draußen in den Tageslichtstunden, Median. EN 17037.";
    fn dgps_5(eye) = "Eye {eye}: DGPs of the worst 5 %" | "Auge {eye}: DGPs der schlimmsten 5 %";
    const DGPS_TIP = "Simplified daylight glare probability exceeded in 5 % of the occupied hours without the sun straight at the eye. Too low where a system throws lobes of sun at it. Wienold 2009; classes of EN 17037." | "Vereinfachte Blendwahrscheinlichkeit, in 5 % der Nutzungszeit ohne Sonne geradewegs im Auge überschritten. Zu niedrig, wo ein System Sonnenkeulen dorthin wirft. Wienold 2009; Klassen der EN 17037.";
    const CLASS_HIGH = "protection: high" | "Schutz: hoch";
    const CLASS_MEDIUM = "protection: medium" | "Schutz: mittel";
    const CLASS_MINIMUM = "protection: minimum" | "Schutz: gering";
    const CLASS_NONE = "protection: none" | "Schutz: keiner";
    fn dgps_above(eye, limit) = "Eye {eye}: time above {limit}" | "Auge {eye}: Zeit über {limit}";
    const DGPS_ABOVE_TIP = "Share of the occupied hours with a DGPs above this limit of EN 17037, of those without the sun straight at the eye." | "Anteil der Nutzungszeit mit DGPs über dieser Grenze der EN 17037, ohne die Stunden mit Sonne geradewegs im Auge.";
    fn sun_at_eye(eye) = "Eye {eye}: sun straight at it" | "Auge {eye}: Sonne geradewegs hinein";
    const SUN_AT_EYE_TIP = "Occupied hours in which the sun's disc is seen unscattered; DGPs is not valid in them." | "Nutzungsstunden, in denen die Sonnenscheibe ungestreut zu sehen ist; DGPs gilt in ihnen nicht.";
    const LIGHTING_ENERGY = "Lighting energy" | "Energie für Beleuchtung";
    const LIGHTING_TIP = "What the lamps take over all hours that were computed, standby included; of a whole year in the unit of LENI. EN 15193-1." | "Was die Lampen über alle gerechneten Stunden aufnehmen, auch in Bereitschaft; über ein ganzes Jahr in der Einheit des LENI. EN 15193-1.";
    const LIGHTING_FULL = "Without daylight" | "Ohne Tageslicht";
    const LIGHTING_FULL_TIP = "The same with all lamps on while somebody is there." | "Dasselbe mit allen Lampen an, solange jemand da ist.";
    fn movements_of(aperture) = "Opening {aperture}: movements" | "Öffnung {aperture}: Bewegungen";
    const MOVEMENTS_TIP = "Changes of its state over all steps of the weather." | "Wechsel der Stellung über alle Schritte des Wetters.";
    fn hours_in_state(aperture, state) = "Opening {aperture}: in state {state}" | "Öffnung {aperture}: in Stellung {state}";
    const HOURS_IN_STATE_TIP = "Hours with light in this state." | "Helle Stunden in dieser Stellung.";
    const MET = "met" | "erfüllt";
    const NOT_MET = "not met" | "nicht erfüllt";
    const OPEN = "open within the error" | "offen im Rahmen der Unsicherheit";
    const ERROR_TIP = "What the errors of the hours leave open: the same year with all light less, and more, by its error" | "Was die Unsicherheiten der Stunden offen lassen: dasselbe Jahr mit allem Licht um sie verringert und vermehrt";
    fn between_is(range) = "Lowest and highest of the sensors: {range}" | "Niedrigster und höchster Wert der Sensoren: {range}";
    const BETWEEN_TIP = "Lowest and highest of the sensors" | "Niedrigster und höchster Wert der Sensoren";

    // Lamps.
    const INSTALLED = "installed" | "installiert";
    fn sunny_day(day, month, energy) = "{day} {month}, {energy} kWh/m² direct normal" | "{day}. {month}, {energy} kWh/m² direkt normal";
    const NO_LAMPS = "No lamps: give the scene some under Weather and year, and compute again." | "Keine Lampen: der Szene unter Wetter und Jahr welche geben und neu rechnen.";
    const NO_SUCH_DAY = "no day of this month was computed" | "kein Tag dieses Monats wurde gerechnet";
    fn lighting_summary(day, energy, error) = "sunniest day of its month: {day} · all months {energy} ± {error} kWh/m²" | "sonnigster Tag seines Monats: {day} · alle Monate {energy} ± {error} kWh/m²";
    const DAY_PLOT = "Lighting power over the day" | "Leistung der Beleuchtung über den Tag";
    fn day_energy(day, energy) = "{day}; {energy} Wh/m²" | "{day}; {energy} Wh/m²";
    fn power_at(from, to, watts, low, high) = "{from}–{to}: {watts} W/m² ({low} to {high} within the error)" | "{from}–{to}: {watts} W/m² ({low} bis {high} im Rahmen der Unsicherheit)";
    fn month_energy(month, energy, error) = "{month}: {energy} ± {error} kWh/m²" | "{month}: {energy} ± {error} kWh/m²";
    const MONTH_PLOT = "Lighting energy by month" | "Energie für Beleuchtung je Monat";
    fn energy_of(energy, span) = "{energy} kWh/m² {span}" | "{energy} kWh/m² {span}";
    const OF_YEAR = "in the year" | "im Jahr";
    const OF_PART = "in the part that was computed" | "im gerechneten Teil";

    // Weather.
    const WEATHER_AND_YEAR = "Weather and year" | "Wetter und Jahr";
    const WEATHER = "Weather" | "Wetter";
    const WEATHER_TIP = "A year that comes with the program, or a weather file (.epw, .wea)" | "Ein mitgeliefertes Jahr oder eine Wetterdatei (.epw, .wea)";
    const WEATHER_FILE = "A weather file (.epw, .wea)…" | "Eine Wetterdatei (.epw, .wea)…";
    const NEW_YORK = "New York, Central Park, 41° N: hot summers, cold and sunny winters" | "New York, Central Park, 41° N: heiße Sommer, kalte und sonnige Winter";
    const PIEDMONT = "Piedmont, northern Italy, 45° N: sunny summers, misty winters" | "Piemont, Norditalien, 45° N: sonnige Sommer, neblige Winter";
    const RENTON = "Renton near Seattle, 47° N: dry summers, long overcast winters" | "Renton bei Seattle, 47° N: trockene Sommer, lange bedeckte Winter";
    const NO_WEATHER = "none" | "keines";
    const WEATHER_PATH_TIP = "A path, from the scene's folder; files can be dropped on the window too" | "Ein Pfad, vom Ordner der Szene aus; Dateien lassen sich auch ins Fenster ziehen";
    const CALENDAR_TIP = "Click an hour, or go by arrow keys: its sky becomes the scene's" | "Eine Stunde anklicken oder mit Pfeiltasten wählen: ihr Himmel wird der der Szene";
    fn weather_is(name, place, source) = "{name}, {place}. {source}" | "{name}, {place}. {source}";
    fn clock_off(minutes) = "Its clock disagrees with its irradiances; they close with an offset of {minutes} min" | "Ihre Uhr passt nicht zu ihren Bestrahlungsstärken; sie gehen mit {minutes} min Versatz auf";
    const READING_WEATHER = "reading the weather…" | "das Wetter wird gelesen…";
    fn weather_taken(name) = "Weather: {name}" | "Wetter: {name}";
    const OCCUPIED_FROM = "Occupied from" | "Genutzt von";
    const OCCUPIED_TO = "Occupied to" | "Genutzt bis";
    const WEEKDAYS = "Monday to Friday" | "Montag bis Freitag";
    const LAMPS = "Lamps" | "Lampen";
    const LAMP_POWER = "Installed power" | "Installierte Leistung";
    const LAMP_TARGET = "Illuminance to be reached" | "Zu erreichende Beleuchtungsstärke";
    const LAMP_CONTROL = "Lamps follow daylight" | "Lampen folgen dem Tageslicht";
    const LAMPS_ALWAYS = "not: always on" | "nicht: immer an";
    const LAMPS_ON_OFF = "on and off" | "an und aus";
    const LAMPS_STEPPED = "in steps" | "in Stufen";
    const LAMPS_DIMMED = "dimmed" | "gedimmt";
    const EYE = "An eye that looks at the façade" | "Ein Auge mit Blick zur Fassade";
    const EYE_TIP = "In the middle of the room, 1.2 m above the floor; other eyes stand in the scene's file" | "In der Raummitte, 1,2 m über dem Boden; andere Augen stehen in der Datei der Szene";
}
