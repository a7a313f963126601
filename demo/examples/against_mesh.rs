//! A model beside a mesh of it: rays through the pixels of pictures from several sides, cast at the closed forms of a `.csg`
//! file and at the triangles that OpenSCAD made of the same model. Fails where they differ by more than flat triangles
//! explain.
//!
//! `cargo run --release --package gsdf-demo --example against_mesh -- MODEL.csg MESH.stl --fa 3 --fs 0.2`
//!
//! Nothing but the rays is shared: the mesh is made by CGAL from the `.scad` file, and asked by parry3d.

use anyhow::{Context, Result, bail, ensure};
use clap::Parser;
use glam::{Mat3, Vec3, vec3};
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_nostd::{Camera, Leaf, Node};
use gsdf_simd::{Caster, RayHits, Rays, Scene};
use parry3d::math::Vector;
use parry3d::query::{Ray as MeshRay, RayCast};
use parry3d::shape::TriMesh;
use rayon::prelude::*;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Compares a model with a mesh of it.
#[derive(Parser)]
struct Arguments {
    /// The model
    model: PathBuf,
    /// The mesh
    mesh: PathBuf,
    /// The `$fa` that the mesh was made with: the least angle of a facet, in degrees
    #[arg(long)]
    fa: f32,
    /// The `$fs` that the mesh was made with: the least size of a facet
    #[arg(long)]
    fs: f32,
    /// The side of the pictures, in pixels
    #[arg(long, default_value_t = 640)]
    size: u32,
}

/// From where the pictures are taken: along no axis, so that every kind of face is seen from some side.
const SIDES: [Vec3; 5] = [
    vec3(1.0, -2.0, 1.3),
    vec3(-1.4, -1.0, 0.7),
    vec3(1.2, 1.6, 0.9),
    vec3(-0.4, 0.9, 2.0),
    vec3(0.5, -0.3, -2.0),
];

/// How far numbers of six digits are off, as a part of the model's size: half a unit of the last one, in the solid and in a few
/// transforms around it.
const WRITTEN: f32 = 2e-5;

/// A depth may be off by the distance of the surfaces over this cosine, or the greater one between ray and normal.
const LEAST_COSINE: f32 = 0.05;

/// How many rays feel for an edge, on a circle around one.
const FEELERS: u16 = 24;

/// Up to which part of the rays may be near an edge; were there more, they could hide what is sought.
const MOST_AT_EDGES: f32 = 0.01;

/// One ray in so many may be off by more than that: where a facet ends beside a silhouette, and a feeler misses the next one.
/// A hole that is moved by a tenth puts hundreds off.
const MOST_BEYOND: u64 = 25_000;

fn main() -> Result<()> {
    let Arguments { model, mesh, fa, fs, size } = Arguments::parse();
    ensure!(fa > 0.0 && fs > 0.0, "--fa and --fs are those that OpenSCAD was given, and above 0");
    let name = model.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let model = Model::load(&model, Reading::default())?;
    let mesh = read_mesh(&mesh)?;
    let sagittas = sagittas(&model, fa, fs)?;

    let bounds = mesh.local_aabb();
    let (center, radius) = (to_glam(bounds.center()), bounds.half_extents().length());
    let written = WRITTEN * radius;
    let coarsest = sagittas.iter().copied().fold(0.0, f32::max);
    let tolerance = Tolerance {
        sagittas,
        written,
        lateral: 2.0 * (coarsest + written),
    };

    let program = model.solid()?;
    let scene = Scene::new(program);
    let caster = Caster::new(&scene);
    let mut tally = Tally::default();
    for side in SIDES {
        let eye = center + side.normalize() * 4.0 * radius;
        // The ball around the model fills the picture.
        let camera = Camera::pinhole(eye, center, Vec3::Z, 1.0 / 15.0_f32.sqrt())?;
        let raster = camera.raster(size, size);
        let pixels = (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
        let directions = pixels
            .map(|(x, y)| -> Result<Vec3> { Ok(raster.ray(x, y)?.direction().normalize()) })
            .collect::<Result<Vec<_>>>()?;
        let ours = cast(&caster, eye, &directions)?;
        let found = ours
            .par_iter()
            .zip(&directions)
            .map(|(ours, direction)| tolerance.compare(&mesh, eye, *direction, ours));
        tally = found.reduce(Tally::default, Tally::joined).joined(tally);
    }
    println!("{name}: {}", tally.told(tolerance.lateral));
    tally.judge()
}

fn read_mesh(path: &Path) -> Result<TriMesh> {
    let mut file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
    let mesh = stl_io::read_stl(&mut file).with_context(|| format!("{} is no STL file", path.display()))?;
    let corners = mesh.vertices.iter().map(|corner| Vector::new(corner[0], corner[1], corner[2]));
    let faces = mesh.faces.iter().map(|face| face.vertices.map(|corner| corner as u32));
    TriMesh::new(corners.collect(), faces.collect()).with_context(|| format!("{} holds no mesh", path.display()))
}

fn to_glam(v: Vector) -> Vec3 {
    vec3(v.x, v.y, v.z)
}

/// How far the facets of each leaf lie within its surface at most.
fn sagittas(model: &Model, fa: f32, fs: f32) -> Result<Vec<f32>> {
    if model
        .matrices()
        .iter()
        .any(|frame| !(*frame * frame.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-5))
    {
        bail!("the model scales solids, which have then fewer facets than their size asks for");
    }
    let leaves = model.nodes().iter().filter_map(|node| match node {
        Node::Leaf { solid, .. } => Some(solid),
        _ => None,
    });
    Ok(leaves.map(|leaf| sagitta(leaf, fa, fs)).collect())
}

/// How far the middle of a facet lies within the circle: the number of facets is the one in OpenSCAD's manual. Those of a
/// sphere are bent both ways.
fn sagitta(leaf: &Leaf, fa: f32, fs: f32) -> f32 {
    let (radius, ways) = match leaf {
        Leaf::Sphere(ball) => (ball.radius(), 2),
        Leaf::CappedCylinder(bar) => (bar.side().radius(), 1),
        Leaf::Cone(cone) => (cone.radius(), 1),
        Leaf::CappedCone(cone) => (cone.bottom_radius().max(cone.top_radius()), 1),
        _ => return 0.0,
    };
    let facets = (360.0 / fa).min(core::f32::consts::TAU * radius / fs).max(5.0).ceil();
    radius * (1.0 - (core::f32::consts::PI / facets).cos().powi(ways))
}

/// What a ray meets of the model.
#[derive(Clone, Copy)]
struct Met {
    /// Infinite where it meets nothing.
    distance: f32,
    normal: Vec3,
    leaf: u32,
}

fn cast(caster: &Caster<'_, '_, Leaf>, eye: Vec3, directions: &[Vec3]) -> Result<Vec<Met>> {
    let plane = |part: fn(&Vec3) -> f32| directions.iter().map(part).collect::<Vec<f32>>();
    let direction = [plane(|v| v.x), plane(|v| v.y), plane(|v| v.z)];
    let origin = eye.to_array().map(|coordinate| vec![coordinate; directions.len()]);
    let mut distance = vec![0.0; directions.len()];
    let [mut x, mut y, mut z] = [distance.clone(), distance.clone(), distance.clone()];
    let mut leaf = vec![0; directions.len()];
    let rays = Rays::new(origin.each_ref().map(Vec::as_slice), direction.each_ref().map(Vec::as_slice));
    let hits = RayHits {
        normal: Some([&mut x, &mut y, &mut z]),
        leaf: Some(&mut leaf),
        ..RayHits::distances(&mut distance)
    };
    caster.cast(&rays, hits)?;
    let met = |index: usize| Met {
        distance: distance[index],
        normal: vec3(x[index], y[index], z[index]),
        leaf: leaf[index],
    };
    Ok((0..directions.len()).map(met).collect())
}

/// By how much a mesh may differ from its model.
struct Tolerance {
    /// How far the facets of each leaf may lie within it.
    sagittas: Vec<f32>,
    /// How far any face may be elsewhere, for the digits that it is written with.
    written: f32,
    /// How far an edge may be elsewhere.
    lateral: f32,
}

impl Tolerance {
    fn compare(&self, mesh: &TriMesh, eye: Vec3, direction: Vec3, ours: &Met) -> Tally {
        let theirs = distance(mesh, eye, direction);
        let mut tally = Tally {
            rays: 1,
            ..Tally::default()
        };
        if ours.distance.is_infinite() && theirs.is_infinite() {
            return tally;
        }
        tally.hits = 1;
        let cosine = ours.normal.dot(direction).abs().max(LEAST_COSINE);
        let sagitta = self.sagittas.get(ours.leaf as usize).copied().unwrap_or(0.0);
        let allowed = (sagitta + self.written) / cosine;
        let difference = (ours.distance - theirs).abs();
        if difference <= allowed {
            tally.worst = (difference, allowed);
            tally.nearest = difference / allowed;
            return tally;
        }
        // Near an edge of the mesh there is a ray beside this one that meets it before ours does, and one that meets it behind.
        let (right, up) = direction.any_orthonormal_pair();
        let beside = (0..FEELERS).map(|feeler| {
            let (sine, cosine) = (f32::from(feeler) / f32::from(FEELERS) * core::f32::consts::TAU).sin_cos();
            distance(mesh, eye + (right * cosine + up * sine) * self.lateral, direction)
        });
        let (near, far) = beside.fold((theirs, theirs), |(near, far), depth| (near.min(depth), far.max(depth)));
        let at_edge = near - allowed <= ours.distance && ours.distance <= far + allowed;
        let is_outline = ours.distance.is_infinite() != theirs.is_infinite();
        let counted = match (is_outline, at_edge) {
            (true, true) => &mut tally.outline,
            (true, false) => &mut tally.outline_beyond,
            (false, true) => &mut tally.depth,
            (false, false) => &mut tally.depth_beyond,
        };
        *counted = 1;
        tally
    }
}

/// How far a ray is from a mesh; infinite where it misses it.
fn distance(mesh: &TriMesh, eye: Vec3, direction: Vec3) -> f32 {
    let vector = |v: Vec3| Vector::new(v.x, v.y, v.z);
    let ray = MeshRay::new(vector(eye), vector(direction));
    mesh.cast_local_ray(&ray, f32::MAX, false).unwrap_or(f32::INFINITY)
}

/// What was found.
#[derive(Clone, Copy, Default)]
struct Tally {
    rays: u64,
    /// Rays that meet the model, the mesh or both.
    hits: u64,
    /// Rays that meet one of them: where the mesh has an edge near by, and elsewhere.
    outline: u64,
    outline_beyond: u64,
    /// Rays that meet both, but not at the same distance: likewise.
    depth: u64,
    depth_beyond: u64,
    /// The greatest difference of all others, and what was allowed there.
    worst: (f32, f32),
    /// The greatest part of what was allowed.
    nearest: f32,
}

impl Tally {
    fn joined(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
            outline: self.outline + other.outline,
            outline_beyond: self.outline_beyond + other.outline_beyond,
            depth: self.depth + other.depth,
            depth_beyond: self.depth_beyond + other.depth_beyond,
            worst: if self.worst.0 < other.worst.0 { other.worst } else { self.worst },
            nearest: self.nearest.max(other.nearest),
        }
    }

    fn told(&self, lateral: f32) -> String {
        format!(
            "{} rays, {} of them meet it\n  outlines: {} rays differ within {lateral:.4} of an edge, {} beyond\n  depths:   {} rays differ \
             at such an edge, {} beyond; all others by {:.5} at most, where {:.5} is allowed, and by {:.0} % of what is allowed",
            self.rays,
            self.hits,
            self.outline,
            self.outline_beyond,
            self.depth,
            self.depth_beyond,
            self.worst.0,
            self.worst.1,
            100.0 * self.nearest
        )
    }

    fn judge(&self) -> Result<()> {
        ensure!(10 * self.hits > self.rays, "hardly a ray meets it: nothing has been compared");
        ensure!(
            self.outline_beyond == 0,
            "{} rays meet the model or the mesh alone, and no edge is near",
            self.outline_beyond
        );
        ensure!(
            MOST_BEYOND * self.depth_beyond <= self.hits,
            "{} rays meet model and mesh at different distances",
            self.depth_beyond
        );
        let at_edges = (self.outline + self.depth) as f32 / self.rays as f32;
        ensure!(
            at_edges <= MOST_AT_EDGES,
            "{:.1} % of the rays are at edges: the mesh is too coarse to tell",
            100.0 * at_edges
        );
        Ok(())
    }
}
