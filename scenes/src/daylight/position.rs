//! Where the sun stands: Blanco-Muriel et al. 2001, "Computing the solar vector", right to half a minute of arc until 2015.

/// A place and a local time, with the defaults of Mitsuba: Tokyo on a summer afternoon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moment {
    /// Degrees north.
    pub latitude_deg: f64,
    /// Degrees east.
    pub longitude_deg: f64,
    /// Hours that local time is ahead of universal time.
    pub timezone: f64,
    /// Year, month and day; months and days count from 1.
    pub date: [i64; 3],
    /// Hours since midnight.
    pub hours: f64,
}

impl Default for Moment {
    fn default() -> Self {
        Self {
            latitude_deg: 35.6894,
            longitude_deg: 139.6917,
            timezone: 9.0,
            date: [2010, 7, 10],
            hours: 15.0,
        }
    }
}

/// The angle of the sun from the zenith, and its azimuth from north through east, in radians.
pub(crate) fn sun_position(moment: &Moment) -> [f64; 2] {
    let universal = moment.hours - moment.timezone;
    // Days since noon of the first of January 2000, universal time.
    let days = days_since_2000(moment.date) as f64 + universal / 24.0 - 0.5;

    let omega = 2.1429 - 0.0010394594 * days;
    let mean_longitude = 4.8950630 + 0.017202791698 * days;
    let anomaly = 6.2400600 + 0.0172019699 * days;
    let longitude = mean_longitude + 0.03341607 * anomaly.sin() + 0.00034894 * (2.0 * anomaly).sin()
        - 0.0001134
        - 0.0000203 * omega.sin();
    let obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * omega.cos();

    let right_ascension = (obliquity.cos() * longitude.sin()).atan2(longitude.cos());
    let declination = (obliquity.sin() * longitude.sin()).asin();

    let greenwich_hours = 6.6974243242 + 0.0657098283 * days + universal;
    let hour_angle = (greenwich_hours * 15.0 + moment.longitude_deg).to_radians() - right_ascension;
    let latitude = moment.latitude_deg.to_radians();
    let cos_zenith =
        latitude.cos() * hour_angle.cos() * declination.cos() + declination.sin() * latitude.sin();
    let zenith = cos_zenith.clamp(-1.0, 1.0).acos();
    let azimuth =
        (-hour_angle.sin()).atan2(declination.tan() * latitude.cos() - latitude.sin() * hour_angle.cos());
    // The observer is not at the centre of the earth.
    let parallax = 6371.01 / 149_597_890.0 * zenith.sin();
    [zenith + parallax, azimuth]
}

/// Of the Gregorian calendar, months and days beyond their range carried over: counted from March, so that the leap day is
/// the last of its year.
fn days_since_2000([year, month, day]: [i64; 3]) -> i64 {
    let month = month - 3;
    let year = year + month.div_euclid(12);
    let month = month.rem_euclid(12);
    let leaps = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    365 * year + leaps + (153 * month + 2) / 5 + day - 1 - 730_425
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        for (date, days) in [
            ([2000, 1, 1], 0),
            ([2000, 2, 29], 59),
            ([2000, 3, 1], 60),
            ([2001, 1, 1], 366),
            ([1999, 12, 31], -1),
            ([2010, 7, 10], 3843),
            ([2100, 3, 1], 36584),
            ([1970, 1, 1], -10957),
        ] {
            assert_eq!(days_since_2000(date), days, "{date:?}");
        }
    }

    /// What Mitsuba 3.9.1 draws of the sun, whose disk is 0.0047 wide; its +x points south and its +y west.
    #[test]
    fn the_sun_stands_where_mitsuba_has_it() {
        let tokyo = Moment::default();
        let winter_noon = Moment { date: [2010, 1, 10], hours: 12.0, ..tokyo };
        let sydney =
            Moment { latitude_deg: -33.0, longitude_deg: 151.0, timezone: 10.0, hours: 10.0, ..tokyo };
        for (moment, [x, y, z]) in [
            (tokyo, [0.0546, 0.6941, 0.7179]),
            (Moment { hours: 9.0, ..tokyo }, [0.0991, -0.6121, 0.7846]),
            (winter_noon, [0.8462, 0.0495, 0.5306]),
            (sydney, [-0.7517, -0.4652, 0.4675]),
        ] {
            let [zenith, azimuth] = sun_position(&moment);
            let got = [-zenith.sin() * azimuth.cos(), -zenith.sin() * azimuth.sin(), zenith.cos()];
            let off = (got[0] - x).hypot(got[1] - y).hypot(got[2] - z);
            assert!(off < 0.006, "{moment:?}: {got:?}");
        }
    }
}
