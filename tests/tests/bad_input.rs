//! Bad input and a failing machine: an exit code, one clear message, and no half of a file.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use limpid_frame::read_exr;
use limpid_tests::start::{Call, call, cornell_box, done, folder, limpid, names_in};

fn refused(folder: &Path, line: &str, code: i32, words: &[&str]) {
    let before = names_in(folder);
    let call = call(folder, line.split(' '));
    assert_eq!(call.code, code, "limpid {line}: {}", call.stderr);
    assert_eq!(call.stdout, "", "limpid {line}");
    for word in words {
        assert!(call.stderr.contains(word), "limpid {line}: no `{word}` in {}", call.stderr);
    }
    assert!(!call.stderr.contains("panicked"), "limpid {line}: {}", call.stderr);
    assert_eq!(names_in(folder), before, "limpid {line}: left something");
}

#[test]
fn a_bad_scene_is_named_with_what_is_wrong_and_leaves_nothing() {
    let folder = folder();
    let scene = |inside: &str| format!("<scene version=\"3.0.0\">{inside}</scene>");
    let whole = fs::read_to_string(cornell_box()).expect("the library is here");
    let cases = [
        ("truncated.xml", whole[..whole.len() / 2].to_owned(), "truncated.xml"),
        ("empty.xml", String::new(), "empty.xml"),
        ("text.txt", "no scene at all".into(), "text.txt"),
        ("bsdf.xml", scene("<shape type=\"sphere\"><bsdf type=\"difuse\"/></shape>"), "difuse"),
        (
            "mesh.xml",
            scene("<shape type=\"obj\"><string name=\"filename\" value=\"no.obj\"/></shape>"),
            "no.obj",
        ),
        ("nan.xml", scene("<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>"), "radius"),
        ("cycle.xml", scene("<include filename=\"cycle.xml\"/>"), "cycle.xml"),
    ];
    for (name, text, word) in cases {
        fs::write(folder.path().join(name), text).expect("writes");
        refused(folder.path(), &format!("render {name} --spp 1 -o o.exr"), 2, &["error: ", name, word]);
        refused(folder.path(), &format!("info {name}"), 2, &[name]);
    }
    refused(folder.path(), "render bsdf.xml", 2, &["bsdf.xml:1:", "1 | <scene", "^", "= help: "]);
    refused(folder.path(), "render nowhere.xml", 2, &["nowhere.xml"]);
    refused(folder.path(), "render .", 2, &[]);
}

#[test]
fn an_unused_parameter_is_a_warning_and_under_strict_an_error() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("ball.xml")).expect("reads");
    let text =
        text.replace("<bsdf type=\"diffuse\">", "<bsdf type=\"diffuse\"><float name=\"shine\" value=\"1\"/>");
    fs::write(folder.path().join("odd.xml"), text).expect("writes");
    let lenient = call(folder.path(), "render odd.xml --spp 1".split(' '));
    assert_eq!(lenient.code, 0, "{}", lenient.stderr);
    assert!(lenient.stderr.contains("warning: odd.xml:15:"), "{}", lenient.stderr);
    assert!(lenient.stderr.contains("shine"), "{}", lenient.stderr);
    refused(folder.path(), "render odd.xml --spp 1 --strict", 2, &["error: odd.xml:15:", "shine"]);
}

#[test]
fn an_export_whose_folder_cannot_be_is_the_calls_fault_and_leaves_nothing() {
    let folder = folder();
    fs::write(folder.path().join("out_files"), "a file").expect("writes");
    fs::create_dir(folder.path().join("a_folder.xml")).expect("makes a folder");
    refused(folder.path(), "export ball.xml -o out.xml", 2, &["error: out_files: "]);
    assert_eq!(fs::read_to_string(folder.path().join("out_files")).expect("reads"), "a file");
    refused(folder.path(), "export ball.xml -o ball.xml/out.xml", 2, &["ball.xml/out.xml: "]);
    refused(folder.path(), "export ball.xml -o a_folder.xml", 2, &["a_folder.xml: "]);
    refused(folder.path(), "export ball.xml -o nowhere/out.xml", 2, &["nowhere/out.xml: "]);
    // where the first file has found its place
    fs::remove_file(folder.path().join("out_files")).expect("removes");
    done(folder.path(), "export ball.xml -o out.xml");
    assert!(folder.path().join("out.xml").is_file());
}

#[test]
fn a_wrong_call_names_the_option_and_the_cure() {
    let folder = folder();
    for (options, words) in [
        ("--spp 0", &["--spp 0: need at least 1 sample; for a preview use `--spp 1`"][..]),
        ("--spp -3", &["--spp"]),
        ("--size 0x4", &["--size 0x4", "640x360"]),
        ("--size 4000000000x4000000000", &["--size 4000000000x4000000000", "GiB", "--crop"]),
        ("--crop 20,0,5,5", &["--crop 20,0,5,5", "24x16"]),
        ("--pixel 24,0", &["--pixel 24,0", "23,15"]),
        ("--layers albdo", &["--layers albdo", "albedo"]),
        ("--denoise nlmm", &["--denoise nlmm", "joint-nlm"]),
        ("--denoise joint-nlm --set radius=-1", &["--set radius=-1", "radius"]),
        ("--denoise joint-nlm --set nothing", &["--set nothing"]),
        ("--set radius=1", &["--denoise"]),
        ("--camera left", &["--camera left", "it has "]),
        ("--threads 0", &["--threads 0"]),
        ("--clamp nan", &["--clamp nan"]),
        ("--time 5", &["--time"]),
        ("-o a.png", &["-o a.png", "a.exr", "--png"]),
        ("-o missing/a.exr", &["missing/a.exr"]),
        ("-o ball.xml/a.exr", &["ball.xml/a.exr"]),
        ("--png ball.xml/a.png", &["ball.xml/a.png"]),
        ("--records ball.xml/a", &["ball.xml/a"]),
    ] {
        refused(folder.path(), &format!("render ball.xml {options}"), 2, words);
    }
    refused(folder.path(), "rendr ball.xml", 2, &["render"]);
}

#[test]
fn bad_frames_are_named() {
    let folder = folder();
    fs::write(folder.path().join("empty.exr"), "").expect("writes");
    fs::write(folder.path().join("text.exr"), "no frame").expect("writes");
    for name in ["empty.exr", "text.exr", "missing.exr"] {
        refused(folder.path(), &format!("denoise {name} -o o.exr"), 2, &[name]);
        refused(folder.path(), &format!("info {name}"), 2, &[name]);
        refused(folder.path(), &format!("metrics {name} {name}"), 2, &[name]);
    }
    done(folder.path(), "render ball.xml --spp 1 -o a.exr");
    done(folder.path(), "render ball.xml --spp 1 --size 9x5 -o b.exr");
    refused(folder.path(), "metrics a.exr b.exr", 2, &["b.exr", "24x16", "9x5"]);
    refused(folder.path(), "denoise a.exr --albedo b.exr -o c.exr", 2, &["b.exr", "24x16", "9x5"]);
    refused(folder.path(), "denoise a.exr a.exr -o c.exr", 2, &["a.exr", "channel"]);
    done(folder.path(), "denoise a.exr -o c.exr");
    refused(folder.path(), "denoise c.exr -o d.exr", 2, &["c.exr", "denoised already"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_the_machines_fault() {
    let folder = folder();
    refused(folder.path(), "render ball.xml --spp 1 -o /dev/full", 3, &["/dev/full"]);
    // Room for the first check, but not for the frame.
    let disk = folder.path().join("disk");
    fs::create_dir(&disk).expect("makes a folder");
    let mount = ["-t", "tmpfs", "-o", "size=32k", "tmpfs"];
    let mounted = std::process::Command::new("mount").args(mount).arg(&disk).output();
    if !mounted.is_ok_and(|output| output.status.success()) {
        println!("skipped: no small file system can be mounted here");
        return;
    }
    let full =
        call(folder.path(), "render ball.xml --spp 1 --size 128x128 --layers all -o disk/p.exr".split(' '));
    let left = names_in(&disk);
    let unmounted = std::process::Command::new("umount").arg(&disk).status();
    assert!(unmounted.is_ok_and(|status| status.success()), "{} stays mounted", disk.display());
    assert_eq!(full.code, 3, "{}", full.stderr);
    assert!(full.stderr.contains("p.exr"), "{}", full.stderr);
    assert!(left.is_empty(), "left {left:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_said_are_the_machines_fault() {
    let full = fs::File::options().write(true).open("/dev/full").expect("Linux has it");
    let output = limpid().arg("methods").stdout(full).output().expect("the program starts");
    assert_eq!(Call::of(&output).code, 3);
}

#[test]
fn a_closed_pipe_is_no_error() {
    let folder = folder();
    for line in ["methods", "info ball.xml", "render ball.xml --spp 1 --json", "--help"] {
        let pipe = || {
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            writer
        };
        let mut program = limpid();
        program.args(line.split(' ')).current_dir(folder.path()).stdout(pipe()).stderr(pipe());
        assert_eq!(program.status().expect("the program starts").code(), Some(0), "limpid {line}");
    }
}

/// Starts a render that would take hours and interrupts it after `wait`, `times` times.
#[cfg(unix)]
fn interrupted(folder: &Path, line: &str, wait: Duration, times: usize) -> Call {
    let mut program = limpid();
    program.args(line.split(' ')).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = program.spawn().expect("the program starts");
    for _ in 0..times {
        std::thread::sleep(wait);
        // The second may come too late for a program that has ended.
        let _ = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).output();
    }
    Call::of(&child.wait_with_output().expect("the program ends"))
}

#[cfg(unix)]
#[test]
fn an_interrupted_render_keeps_what_is_done() {
    let folder = folder();
    let line = "render ball.xml --size 64x64 --spp 200000 --denoise joint-nlm -o a.exr --json";
    // Interrupted before the first sample it ends with nothing: then this machine is slow today.
    for wait in [1, 4, 16] {
        let call = interrupted(folder.path(), line, Duration::from_secs(wait), 1);
        assert_eq!(call.code, 130, "{}", call.stderr);
        if folder.path().join("a.exr").exists() {
            let frame = read_exr(&folder.path().join("a.exr")).expect("is whole");
            assert!(frame.metadata.contains_key("limpid:interrupted"));
            let red = frame.channel("R").expect("has its picture");
            assert!(red.iter().all(|v| v.is_finite()) && red.iter().any(|v| *v > 0.0));
            assert!(call.stderr.contains("a.exr") && call.stderr.contains("interrupted"), "{}", call.stderr);
            assert!(call.stdout.contains("\"interrupted\":true"), "{}", call.stdout);
            assert_eq!(names_in(folder.path()), ["a.exr", "ball.xml"]);
            return;
        }
    }
    panic!("16 seconds were not enough for the first sample");
}

#[cfg(unix)]
#[test]
fn a_second_interrupt_ends_at_once_and_leaves_no_half_file() {
    let folder = folder();
    // With records a tile gets all its samples at once, so that the first interrupt takes its time.
    let line = "render ball.xml --size 64x64 --spp 65536 --records records -o a.exr";
    let call = interrupted(folder.path(), line, Duration::from_secs(2), 2);
    assert_eq!(call.code, 130, "{}", call.stderr);
    assert!(!folder.path().join("a.exr").exists() || read_exr(&folder.path().join("a.exr")).is_ok());
}
