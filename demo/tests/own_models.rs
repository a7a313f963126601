//! The models of the project are read as they are.

use gsdf_demo::model::Model;
use gsdf_demo::model::bounds::Reach;
use gsdf_demo::model::evaluate::Reading;
use std::path::{Path, PathBuf};

fn models() -> Vec<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let files = directory
        .read_dir()
        .expect("the models are there")
        .map(|entry| entry.expect("a file").path());
    files.filter(|path| path.extension().is_some_and(|kind| kind == "csg")).collect()
}

#[test]
fn each_is_a_solid_with_bounds() {
    let models = models();
    assert!(models.len() >= 12, "only {} are left", models.len());
    for path in models {
        let model = Model::load(&path, Reading::default()).unwrap_or_else(|error| panic!("{error:#}"));
        let program = model.solid().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(matches!(model.reach(), Reach::Within(_)), "{} has no bounds", path.display());
        let named = |leaf: usize| model.leaves().get(leaf).and_then(|leaf| leaf.colour);
        assert!(
            (0..program.leaves()).all(|leaf| named(leaf).is_some()),
            "{} leaves solids without a colour",
            path.display()
        );
    }
}

#[test]
fn the_sponge_is_made_of_few_hundred_solids() {
    let sponge = models()
        .into_iter()
        .find(|path| path.ends_with("sponge.csg"))
        .expect("there is a sponge");
    let sponge = Model::load(&sponge, Reading::default()).unwrap_or_else(|error| panic!("{error:#}"));
    let program = sponge.solid().expect("it is a solid");
    // One cube and 1 + 8 + 64 square holes along each axis.
    assert_eq!(program.leaves(), 1 + 3 * 73);
    // What is left of a cube of side 27 is (20/27)^3 of it: counted in unit cubes, 20^3.
    let mut scratch = vec![gsdf_nostd::Span::EMPTY; program.leaves()];
    let mut within = 0;
    for x in 0..27_u8 {
        for y in 0..27_u8 {
            let at = glam::vec3(f32::from(x) + 0.5, f32::from(y) + 0.5, -1.0);
            let ray = gsdf_nostd::Ray::new(at, glam::Vec3::Z).expect("a ray");
            let crossings = program.along(ray, &mut scratch).expect("room for all leaves").crossings();
            let length: f32 = crossings
                .map(|crossing| if crossing.entering { -crossing.t } else { crossing.t })
                .sum();
            within += length.round() as u32;
        }
    }
    assert_eq!(within, 20_u32.pow(3));
}
