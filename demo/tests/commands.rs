//! The program as one calls it: what it prints, where it ends, and what it leaves behind.

mod program;

use anyhow::{Context, Result};
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_nostd::{Ray, Span};
use program::{MODEL, directory, done, ends_in_peace, piped, rays, refused, written};
use std::fs;
use std::io::{Read, Write};

#[test]
fn what_is_wrong_is_one_line_status_two_and_no_file() -> Result<()> {
    let directory = directory()?;
    fs::write(directory.path().join("broken.csg"), "cube(1);\nblob();")?;
    fs::write(directory.path().join("binary.csg"), b"cube(1);\n\xff\xfe\0")?;
    fs::write(directory.path().join("empty.csg"), "group();")?;
    fs::write(directory.path().join("rays"), "0 0 9 0 0 -1\n1 2 three 4 5 6\n")?;
    for (arguments, named) in [
        (&["render", "missing.csg", "--out", "a.png"][..], "missing.csg"),
        (
            &["render", "broken.csg", "--out", "a.png"],
            "broken.csg: line 2, column 1: found `blob`",
        ),
        (
            &["render", "binary.csg", "--out", "a.png"],
            "binary.csg: line 2, column 1: found bytes that are no text",
        ),
        (&["render", "empty.csg", "--out", "a.png"], "empty"),
        (&["render", "part.csg", "--fov", "180", "--out", "a.png"], "--fov"),
        (
            &[
                "render", "part.csg", "--eye", "0,0,9", "--up", "0,0,1", "--target", "0,0,0", "--out", "a.png",
            ],
            "camera",
        ),
        (&["render", "part.csg", "--out", "part.csg/a.png"], "part.csg"),
        (&["info", "broken.csg"], "broken.csg"),
        (&["info"], "MODEL"),
        (&["cast", "part.csg", "--rays", "nowhere"], "nowhere"),
        (
            &["cast", "part.csg", "--rays", "rays", "--out", "answers"],
            "rays: line 2: found `three`",
        ),
        (&["export", "empty.csg", "--rust", "--out", "a.rs"], "empty"),
        (&["export", "part.csg", "--out", "a.rs"], "--rust"),
        (&["frobnicate"], "frobnicate"),
    ] {
        refused(directory.path(), arguments, named)?;
    }
    Ok(())
}

#[test]
fn models_are_summed_up() -> Result<()> {
    let directory = directory()?;
    let told: serde_json::Value = serde_json::from_str(&done(directory.path(), &["info", "part.csg", "--json"])?)?;
    assert_eq!(told["leaves"], 2 + 7);
    assert_eq!(
        told["kinds"],
        serde_json::json!({"capped cylinder": 1, "cuboid": 2, "half-space": 6})
    );
    assert_eq!((&told["frames"], &told["max_sweeps"]), (&1.into(), &19.into()));
    let text = done(directory.path(), &["info", "part.csg"])?;
    assert!(text.contains("2 cuboid") && text.contains("flash"), "{text}");
    Ok(())
}

#[test]
fn every_kind_of_picture_is_written() -> Result<()> {
    let directory = directory()?;
    for (aov, file) in [
        ("color", "part.png"),
        ("depth", "part-depth.png"),
        ("normal", "part-normal.png"),
        ("id", "part-id.png"),
        ("sweeps", "part-sweeps.png"),
    ] {
        let text = done(directory.path(), &["render", "part.csg", "--aov", aov, "--size", "60x40", "--json"])?;
        let told: serde_json::Value = serde_json::from_str(&text)?;
        assert_eq!(told["file"], file);
        let image = image::open(directory.path().join(file))?;
        assert_eq!((image.width(), image.height()), (60, 40));
        let deep = matches!(image, image::DynamicImage::ImageLuma16(_) | image::DynamicImage::ImageRgb16(_));
        assert_eq!(deep, aov != "color");
        if aov == "id" {
            let ids = image.to_luma16();
            let hits = ids.pixels().filter(|pixel| pixel.0[0] > 0).count();
            assert_eq!(told["hits"], hits);
            // Seen from the front the hexagon, which is at greater x, is on the right.
            let columns = |small: bool| {
                ids.enumerate_pixels()
                    .filter(move |(_, _, pixel)| pixel.0[0] > 0 && (pixel.0[0] <= 2) == small)
            };
            let middle = |small: bool| columns(small).map(|(x, _, _)| u64::from(x)).sum::<u64>() / columns(small).count().max(1) as u64;
            assert!(middle(true) + 10 < middle(false), "{} {}", middle(true), middle(false));
        }
        if aov == "depth" {
            let depths: Vec<u16> = image
                .to_luma16()
                .pixels()
                .map(|pixel| pixel.0[0])
                .filter(|depth| *depth > 0)
                .collect();
            assert_eq!((depths.iter().min(), depths.iter().max()), (Some(&1), Some(&65535)));
        }
    }
    Ok(())
}

#[test]
fn rays_are_answered_in_order_with_what_the_program_says() -> Result<()> {
    let directory = directory()?;
    let rays = rays(5000);
    fs::write(directory.path().join("rays"), written(&rays))?;
    let first = done(directory.path(), &["cast", "part.csg", "--rays", "rays"])?;
    let all = done(directory.path(), &["cast", "part.csg", "--rays", "rays", "--all"])?;
    let json = done(
        directory.path(),
        &["cast", "part.csg", "--rays", "rays", "--json", "--threads", "1"],
    )?;
    done(directory.path(), &["cast", "part.csg", "--rays", "rays", "--out", "answers"])?;
    assert_eq!(fs::read_to_string(directory.path().join("answers"))?, first);

    let model = Model::read(MODEL, Reading::default())?;
    let program = model.program()?;
    let mut spans = vec![Span::<f32>::EMPTY; program.leaves()];
    let (mut first, mut all, mut json) = (first.lines(), all.lines(), json.lines());
    let mut hits = 0;
    for (number, [a, b, c, d, e, f]) in rays.into_iter().enumerate() {
        let ray = Ray::new([a, b, c].into(), [d, e, f].into())?;
        let hit = program.along(ray, &mut spans)?.cast();
        let told: Vec<_> = first.next().context("an answer is missing")?.split(' ').collect();
        let in_json: serde_json::Value = serde_json::from_str(json.next().context("an answer is missing")?)?;
        match hit {
            None => {
                assert_eq!(told, ["miss"]);
                assert_eq!(in_json, serde_json::json!({"miss": true}));
            }
            Some(hit) => {
                hits += 1;
                let numbers: Vec<f32> = told[..4].iter().map(|number| number.parse()).collect::<Result<_, _>>()?;
                assert_eq!(numbers, [hit.t, hit.normal.x, hit.normal.y, hit.normal.z]);
                assert_eq!(told[4], hit.leaf.to_string());
                assert_eq!(told[5], if hit.entering { "entering" } else { "leaving" });
                assert_eq!((&in_json["leaf"], &in_json["entering"]), (&hit.leaf.into(), &hit.entering.into()));
            }
        }
        let crossings: Vec<_> = program.along(ray, &mut spans)?.crossings().collect();
        for crossing in &crossings {
            let told: Vec<_> = all.next().context("a crossing is missing")?.split(' ').collect();
            assert_eq!(told[0], number.to_string());
            assert_eq!((told[1].parse(), told[5].parse()), (Ok(crossing.t), Ok(crossing.leaf)));
            assert_eq!(told[6], if crossing.entering { "entering" } else { "leaving" });
        }
        if crossings.is_empty() {
            assert_eq!(all.next(), Some(format!("{number} miss").as_str()));
        }
    }
    assert!((1000..4900).contains(&hits), "{hits}");
    assert_eq!((first.next(), all.next(), json.next()), (None, None, None));
    Ok(())
}

#[test]
fn that_nobody_reads_on_is_no_error() -> Result<()> {
    let directory = directory()?;
    for tier in ["robust", "certified", "f64"] {
        let (child, mut input, mut output) = piped(directory.path(), &["cast", "part.csg", "--tier", tier])?;
        // Beside the hole.
        let line = b"1.5 0 9 0.01 0.02 -1\n";
        input.write_all(line)?;
        let mut answer = [0; 8];
        // Answers come as soon as there are rays.
        output.read_exact(&mut answer)?;
        drop(output);
        ends_in_peace(child, input, line).with_context(|| tier)?;
    }
    Ok(())
}
