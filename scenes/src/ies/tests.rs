use super::*;

/// A file with these angles and values, all factors 1.
fn file(vertical: &[f32], horizontal: &[f32], candelas: &[f32]) -> String {
    let list = |values: &[f32]| values.iter().map(f32::to_string).collect::<Vec<_>>().join(" ");
    format!(
        "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 100\n{}\n{}\n{}\n",
        vertical.len(),
        horizontal.len(),
        list(vertical),
        list(horizontal),
        list(candelas)
    )
}

fn read(text: &str) -> IesProfile {
    parse(text.as_bytes()).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

/// ∫ I sin θ dθ dφ over the sphere = 4π · mean, for profiles whose integral is known.
#[test]
fn profiles_integrate_to_their_flux() {
    let angles: Vec<f32> = (0..=180).map(|i| i as f32).collect();
    // I = max(cos θ, 0): ∫ = π
    let cosine: Vec<f32> = angles.iter().map(|a| a.to_radians().cos().max(0.0)).collect();
    let profile = read(&file(&angles, &[0.0], &cosine));
    assert!((4.0 * profile.mean() - 1.0).abs() < 1e-3, "{}", profile.mean());
    // the same light upwards, of 90 to 180 degrees
    let up: Vec<f32> = cosine[..=90].iter().rev().copied().collect();
    let profile = read(&file(&angles[90..], &[0.0], &up));
    assert!((4.0 * profile.mean() - 1.0).abs() < 1e-3, "{}", profile.mean());
    // linear in the azimuth from 0 to 2 over each quarter, the same at all heights: mean 1
    let profile = read(&file(&[0.0, 180.0], &[0.0, 90.0], &[0.0, 0.0, 2.0, 2.0]));
    assert!((profile.mean() - 1.0).abs() < 1e-12, "{}", profile.mean());
}

/// Against midpoints of 2^16 rings, and for the fan against ∫ sin θ dθ = 2.
#[test]
fn narrow_beams_and_fans_keep_their_flux() {
    for edge in [60.0, 0.3, 0.2, 1e-3] {
        let end = 1.05 * edge;
        let profile = read(&file(&[0.0, edge, end, 90.0], &[0.0], &[1e6, 5e5, 0.0, 0.0]));
        let end = f64::from(end);
        let ring = |i: i32| {
            let vertical = end * (f64::from(i) + 0.5) / f64::from(1 << 16);
            profile.at(vertical, 0.0) * vertical.to_radians().sin()
        };
        let truth = 0.5 * (0..1 << 16).map(ring).sum::<f64>() * end.to_radians() / f64::from(1 << 16);
        assert!((profile.mean() / truth - 1.0).abs() < 1e-8, "{edge}: {} {truth}", profile.mean());
    }
    let wall: Vec<f32> = [0.0, 9.0, 9.0, 0.0, 0.0].iter().flat_map(|&c| [c, c]).collect();
    let fan = read(&file(&[0.0, 180.0], &[0.0, 1.0, 1.5, 2.5, 360.0], &wall));
    assert!((fan.mean() / (9.0 * 1.5 / 360.0) - 1.0).abs() < 1e-12, "{}", fan.mean());
}

#[test]
fn a_half_and_a_quarter_are_mirrored() {
    let quarter = read(&file(&[0.0, 90.0], &[0.0, 45.0, 90.0], &[9.0, 1.0, 9.0, 2.0, 9.0, 3.0]));
    assert_eq!(quarter.horizontal_deg, [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0]);
    for (around, candelas) in
        [(0.0, 1.0), (45.0, 2.0), (135.0, 2.0), (180.0, 1.0), (270.0, 3.0), (337.5, 1.5)]
    {
        assert_eq!(quarter.at(90.0, around), candelas, "{around}");
    }
    let half = read(&file(&[0.0, 90.0], &[0.0, 180.0], &[9.0, 1.0, 9.0, 3.0]));
    assert_eq!([45.0, 90.0, 270.0, 360.0].map(|a| half.at(90.0, a)), [1.5, 2.0, 2.0, 1.0]);
    let side = read(&file(&[0.0, 90.0], &[90.0, 180.0, 270.0], &[9.0, 1.0, 9.0, 2.0, 9.0, 3.0]));
    assert_eq!(
        [0.0, 45.0, 90.0, 180.0, 270.0, 315.0].map(|a| side.at(90.0, a)),
        [2.0, 1.5, 1.0, 2.0, 3.0, 2.5]
    );
    // the same without planes at 180, and so at 0
    let side =
        read(&file(&[0.0, 90.0], &[90.0, 170.0, 200.0, 270.0], &[9.0, 1.0, 9.0, 2.0, 9.0, 5.0, 9.0, 4.0]));
    assert_eq!(
        [10.0, 355.0, 345.0, 340.0, 0.0, 360.0, 90.0, 130.0, 50.0].map(|a| side.at(90.0, a)),
        [2.0, 3.5, 4.5, 5.0, 3.0, 3.0, 1.0, 1.5, 1.5]
    );
    // all around, the last plane left out
    let whole = read(&file(&[0.0, 90.0], &[0.0, 90.0, 270.0], &[9.0, 1.0, 9.0, 2.0, 9.0, 3.0]));
    assert_eq!([90.0, 180.0, 315.0].map(|a| whole.at(90.0, a)), [2.0, 2.5, 2.0]);
    // between the vertical angles, and beyond them
    assert_eq!([0.0, 45.0, 90.0, 90.1, 180.0].map(|a| half.at(a, 0.0)), [9.0, 5.0, 1.0, 0.0, 0.0]);
}

#[test]
fn old_and_odd_files_are_read() {
    // 1986: no first line; commas, several numbers a line, a table of tilts, factors 2 · 3 · 0.5, lines of Windows
    let text = "A LAMP\r\nTILT=INCLUDE\r\n1\r\n2\r\n0 90\r\n1, 0.9\r\n1,1000,2,3,1,1,1,0,0,0\r\n3 0.5 50\r\n0 30\r\n60 0 5 7\r\n\t2.5e0\r\n";
    let profile = read(text);
    assert_eq!(
        (profile.vertical_deg, profile.candelas),
        (vec![0.0, 30.0, 60.0], [15.0, 21.0, 7.5].repeat(2))
    );
    // a value in one direction alone
    let point = read(&file(&[0.0], &[0.0], &[5.0]));
    assert_eq!((point.at(0.0, 10.0), point.at(1.0, 10.0)), (5.0, 0.0));
    // Latin-1 in a keyword
    let mut bytes = b"[MANUFAC] L\xe4mp\n".to_vec();
    bytes.extend(file(&[0.0, 90.0], &[0.0], &[1.0, 1.0]).bytes());
    assert!(parse(&bytes).is_ok());
}

#[test]
fn wrong_files_are_refused_with_the_line() {
    let good = file(&[0.0, 90.0], &[0.0, 90.0], &[1.0, 2.0, 3.0, 4.0]);
    assert!(parse(good.as_bytes()).is_ok());
    for (from, to, line, problem) in [
        ("TILT", "TLIT", 1, "no line TILT="),
        ("1 -1 1 2 2 1", "1 -1 1 2 2 2", 4, "type B"),
        ("1 -1 1 2 2", "1 -1 1 2 3", 5, "more than the file has"),
        ("1 -1 1 2 2", "1 -1 1 0 2", 4, "number of vertical angles is 0"),
        ("1 -1 1 2 2", "1 -1 1 1e18 1e18", 4, "number of vertical angles is"),
        ("1 1 100", "1 x 100", 5, "\"x\", where the second ballast factor belongs"),
        ("1 1 100", "-1 1 100", 5, "a factor of -1"),
        ("\n0 90\n0 90\n", "\n90 0\n0 90\n", 6, "vertical angle of 0 degrees after one of 90"),
        ("\n0 90\n0 90\n", "\n0 90\n0 361\n", 7, "horizontal angle of 361 degrees"),
        ("\n0 90\n0 90\n", "\n0 90\n0 80\n", 8, "horizontal angles from 0 to 80"),
        ("1 2 3 4", "1 2 -3 4", 8, "a value of -3 candelas"),
        ("1 2 3 4", "1 2 nan 4", 8, "\"nan\""),
        ("1 2 3 4", "1 2 3", 5, "more than the file has"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = parse(good.replacen(from, to, 1).as_bytes()).expect_err(to);
        assert!(error.problem.contains(problem) && error.line == line, "{to}: {error:?}");
    }
    let of_type_b = good.replacen("\n0 90\n", "\n-90 90\n", 1);
    let error = parse(of_type_b.as_bytes()).unwrap_err();
    assert!(
        error.problem == "a vertical angle of -90 degrees" && error.help.contains("type A or B"),
        "{error:?}"
    );
    // cut anywhere, and with any byte changed: an error or a profile, never a panic
    for cut in 0..good.len() {
        let _ = parse(&good.as_bytes()[..cut]);
        for byte in [b'0', b'9', b'-', b' ', b'\n', b'e', 0xff] {
            let mut bytes = good.clone().into_bytes();
            bytes[cut] = byte;
            if let Ok(profile) = parse(&bytes) {
                assert!(profile.mean().is_finite(), "{profile:?}");
            }
        }
    }
}
