//! `--tier`: what is told is what the library finds in that arithmetic.

mod program;

use anyhow::{Context, Result};
use gsdf_demo::commands::tier::{Alone, Distance, Tier};
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_nostd::{Bounded, CertifiedScratch, Lane, Plain, Program, Ray, Settled, Span};
use gsdf_trade::{Primitive, Solids};
use image::GenericImageView;
use program::{MODEL, directory, done, rays, refused, written};
use serde_json::{Value, json};
use std::fs;

const TIERS: [&str; 4] = ["fast", "robust", "certified", "f64"];

/// The rays as a file, and the answers to them, in text and in JSON.
fn answers(tier: &str, rays: &[[f32; 6]], more: &[&str]) -> Result<(Vec<String>, Vec<Value>)> {
    let directory = directory()?;
    fs::write(directory.path().join("rays"), written(rays))?;
    let mut arguments = vec!["cast", "part.csg", "--rays", "rays", "--tier", tier];
    arguments.extend(more);
    let lines = done(directory.path(), &arguments)?.lines().map(str::to_owned).collect();
    arguments.push("--json");
    let json = done(directory.path(), &arguments)?;
    let json = json.lines().map(serde_json::from_str).collect::<Result<_, _>>()?;
    Ok((lines, json))
}

fn model() -> Model {
    Model::read(MODEL, Reading::default()).expect("it is a model")
}

/// What a plain cast in some arithmetic finds, as a line: the distance in that arithmetic.
fn expected<T: Lane>(program: Program<'_, Primitive>, ray: Ray, like: T, distance: fn(T) -> String) -> Result<String> {
    let mut spans = vec![Span::empty_like(like); program.leaves()];
    let Some(hit) = program.along(ray, &mut spans)?.cast() else {
        return Ok("miss".to_owned());
    };
    let crossing = program.along(ray, &mut spans)?.crossings().next().context("it is hit")?;
    let side = if hit.entering { "entering" } else { "leaving" };
    let (n, leaf) = (hit.normal, hit.leaf);
    assert_eq!((crossing.leaf, crossing.t.to_f32()), (leaf, hit.t));
    Ok(format!("{} {} {} {} {leaf} {side}", distance(crossing.t), n.x, n.y, n.z))
}

/// The numbers of a line read back, so that they may be written in any way; the other words as they are.
fn read_back(line: &str) -> Vec<String> {
    let word = |word: &str| {
        word.parse::<f64>()
            .map_or_else(|_| word.to_owned(), |number| number.to_bits().to_string())
    };
    line.split(' ').map(word).collect()
}

#[test]
fn every_tier_tells_what_the_library_finds_in_it() -> Result<()> {
    let (model, rays) = (model(), rays(2000));
    let solids = Solids::of(&model.program()?)?;
    let program = solids.program()?;
    for tier in ["fast", "robust", "f64"] {
        let (lines, _) = answers(tier, &rays, &[])?;
        assert_eq!(lines.len(), rays.len());
        for (line, [a, b, c, d, e, f]) in lines.iter().zip(&rays) {
            let ray = Ray::new([*a, *b, *c].into(), [*d, *e, *f].into())?;
            let expected = match tier {
                "fast" => expected(program, ray, Plain(0.0_f32), |t| t.0.to_string())?,
                "robust" => expected(program, ray, 0.0_f32, |t| t.to_string())?,
                _ => expected(program, ray, 0.0_f64, |t| t.to_string())?,
            };
            assert_eq!(read_back(line), read_back(&expected), "{tier}: {ray:?}");
        }
    }
    Ok(())
}

#[test]
fn tiers_differ_and_agree_as_they_promise() -> Result<()> {
    let rays = rays(2000);
    let of = |tier| -> Result<Vec<Option<f64>>> {
        let (_, json) = answers(tier, &rays, &[])?;
        Ok(json.iter().map(|line| line["distance"].as_f64()).collect())
    };
    let exact = of("f64")?;
    for tier in ["fast", "robust", "certified"] {
        let (mut hits, mut other) = (0, 0);
        for (found, exact) in of(tier)?.into_iter().zip(&exact) {
            assert_eq!(found.is_some(), exact.is_some(), "{tier}");
            let (Some(found), Some(exact)) = (found, exact) else { continue };
            assert!((found - exact).abs() <= 1e-5 * exact, "{tier}: {found} for {exact}");
            hits += 1;
            other += usize::from(found != *exact);
        }
        // Double precision tells digits that no single one has.
        assert!(hits > 500 && other > hits / 2, "{tier}: {other} of {hits}");
    }
    Ok(())
}

#[test]
fn certified_answers_have_their_bounds_and_how_they_were_settled() -> Result<()> {
    let mut rays = rays(2000);
    // Along the rim of the hole, and along a face.
    rays.extend([[1.0, 0.0, 9.0, 0.0, 0.0, -1.0], [-9.0, 0.0, 2.0, 1.0, 0.0, 0.0]]);
    let (lines, json) = answers("certified", &rays, &[])?;
    let solids = Solids::of(&model().program()?)?;
    let program = solids.program()?;
    let mut single = vec![Span::empty_like(Bounded::exact(0.0)); program.leaves()];
    let mut double = vec![Span::empty_like(Bounded::exact(0.0)); program.leaves()];
    let mut tie = vec![Span::empty_like(0.0); program.leaves()];
    let mut ties = 0;
    assert_eq!((lines.len(), json.len()), (rays.len(), rays.len()));
    for ((line, json), [a, b, c, d, e, f]) in lines.iter().zip(&json).zip(rays) {
        let ray = Ray::new([a, b, c].into(), [d, e, f].into())?;
        let scratch = CertifiedScratch {
            single: &mut single,
            double: &mut double,
            tie: &mut tie,
        };
        let found = program.cast_certified(&ray, scratch)?;
        let settled = match found.settled {
            Settled::Single => "single",
            Settled::Double => "double",
            Settled::Tie => "tie",
        };
        ties += usize::from(settled == "tie");
        let words: Vec<_> = line.split(' ').collect();
        let [told @ .., bound, how] = &words[..] else { panic!("{line}") };
        assert_eq!((bound.parse(), *how), (Ok(found.bound), settled), "{line}");
        assert_eq!(json["settled"], settled);
        // JSON has no infinity.
        let bound = found.bound.is_finite().then_some(f64::from(found.bound));
        assert_eq!(json["bound"].as_f64().map(|bound| bound as f32), bound.map(|bound| bound as f32));
        match found.hit {
            None => assert_eq!((told, &json["miss"]), (&["miss"][..], &true.into())),
            Some(hit) => {
                assert_eq!((told[0].parse(), told[4].parse()), (Ok(hit.t), Ok(hit.leaf)));
                assert_eq!((told.len(), &json["leaf"]), (6, &hit.leaf.into()));
            }
        }
    }
    assert!((1..200).contains(&ties), "{ties}");
    Ok(())
}

#[test]
fn all_crossings_are_told_in_a_tier() -> Result<()> {
    let rays = rays(300);
    let (_, exact) = answers("f64", &rays, &["--all"])?;
    let (lines, _) = answers("f64", &rays, &["--all"])?;
    let model = model();
    let solids = Solids::of(&model.program()?)?;
    let mut alone = Alone::new(solids.program()?, Tier::F64);
    let mut lines = lines.iter();
    for (answer, [a, b, c, d, e, f]) in exact.iter().zip(&rays) {
        let ray = Ray::new([*a, *b, *c].into(), [*d, *e, *f].into())?;
        let expected: Vec<f64> = alone
            .all(&ray)
            .iter()
            .map(|crossing| match crossing.distance {
                Distance::Double(distance) => distance,
                Distance::Single(distance) => panic!("{distance} is no double"),
            })
            .collect();
        let told: Vec<f64> = answer["crossings"]
            .as_array()
            .context("a list")?
            .iter()
            .filter_map(|crossing| crossing["distance"].as_f64())
            .collect();
        assert_eq!(told.len(), expected.len());
        // Who reads the JSON here rounds its numbers in the last place; the lines below are read exactly.
        assert!(
            told.iter()
                .zip(&expected)
                .all(|(told, expected)| (told - expected).abs() <= 1e-15 * expected)
        );
        for distance in &expected {
            let line = lines.next().context("a line is missing")?;
            assert_eq!(line.split(' ').nth(1).and_then(|word| word.parse().ok()), Some(*distance));
        }
        if expected.is_empty() {
            assert!(lines.next().is_some_and(|line| line.ends_with(" miss")));
        }
    }
    assert_eq!(lines.next(), None);
    Ok(())
}

/// On the eye's side of rounding all tiers paint one picture, and the robust one whether it is cast in tiles or ray by ray.
#[test]
fn pictures_are_painted_in_every_tier() -> Result<()> {
    let directory = directory()?;
    let mut ids = Vec::new();
    for tier in TIERS {
        for aov in ["id", "color", "depth"] {
            let file = format!("{tier}-{aov}.png");
            let arguments = [
                "render", "part.csg", "--tier", tier, "--aov", aov, "--size", "60x40", "--json", "--out", &file,
            ];
            let told: Value = serde_json::from_str(&done(directory.path(), &arguments)?)?;
            assert_eq!(told["tier"], tier);
            let settled = &told["settled"];
            if tier == "certified" {
                let counts = ["single", "double", "tie"].map(|how| settled[how].as_u64().unwrap_or(0));
                assert_eq!(counts.iter().sum::<u64>(), 60 * 40);
                assert!(counts[0] > 2000, "{counts:?}");
            } else {
                assert_eq!(settled, &Value::Null);
            }
            let image = image::open(directory.path().join(&file))?;
            assert_eq!((image.width(), image.height()), (60, 40));
            if aov == "id" {
                let shown = image.to_luma16();
                assert_eq!(told["hits"], shown.pixels().filter(|pixel| pixel.0[0] > 0).count());
                ids.push(shown);
            }
        }
    }
    assert!(ids.iter().all(|shown| *shown == ids[0]));
    let colours = |tier: &str| image::open(directory.path().join(format!("{tier}-color.png")));
    let (robust, certified) = (colours("robust")?, colours("certified")?);
    let differing = robust.pixels().zip(certified.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing < 60, "{differing}");
    Ok(())
}

#[test]
fn sweeps_are_those_of_the_tier() -> Result<()> {
    let directory = directory()?;
    let mut of_tiers = Vec::new();
    for tier in ["fast", "robust", "f64"] {
        done(
            directory.path(),
            &[
                "render", "part.csg", "--aov", "sweeps", "--tier", tier, "--size", "30", "--out", "a.png",
            ],
        )?;
        of_tiers.push(image::open(directory.path().join("a.png"))?.to_luma16());
    }
    assert!(of_tiers[0].pixels().any(|pixel| pixel.0[0] > 1));
    assert!(of_tiers.iter().all(|sweeps| *sweeps == of_tiers[0]));
    Ok(())
}

#[test]
fn what_a_tier_cannot_tell_is_refused() -> Result<()> {
    let directory = directory()?;
    for (arguments, named) in [
        (&["cast", "part.csg", "--tier", "certified", "--all"][..], "--all"),
        (&["cast", "part.csg", "--tier", "double"], "--tier"),
        (&["render", "part.csg", "--tier", "certified", "--aov", "sweeps"], "--aov sweeps"),
        (&["render", "part.csg", "--tier", "exact"], "certified, f64"),
    ] {
        refused(directory.path(), arguments, named)?;
    }
    Ok(())
}

#[test]
fn a_ray_that_misses_everything_says_so_in_every_tier() -> Result<()> {
    for tier in TIERS {
        let (lines, json) = answers(tier, &[[0.0, 0.0, 99.0, 0.0, 0.0, 1.0]], &[])?;
        if tier == "certified" {
            assert_eq!(lines, ["miss 0 single"]);
            assert_eq!(json, [json!({"miss": true, "bound": 0.0, "settled": "single"})]);
        } else {
            assert_eq!(lines, ["miss"]);
            assert_eq!(json, [json!({"miss": true})]);
        }
    }
    Ok(())
}
