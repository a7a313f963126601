//! scratch calibrate
use gsdf_tests::{corpus, sandwich::computed_span, shape::{KINDS, Shape}};
use rand::SeedableRng;
use std::collections::BTreeMap;
#[test]
fn calibrate() {
    let n: usize = std::env::var("N").ok().and_then(|s| s.parse().ok()).unwrap_or(1000);
    for (kind, name) in KINDS.iter().enumerate() {
        let mut rng = rand_pcg::Pcg64::seed_from_u64(kind as u64);
        let mut worst: BTreeMap<corpus::Class, (f64, Option<(gsdf_tests::sandwich::Trial, gsdf_nostd::Span<f32>)>, usize)> = BTreeMap::new();
        let mut hits = 0;
        for i in 0..n {
            let size = gsdf_tests::shape::log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size);
            let reach = if i % 2 == 0 { 100.0 } else { 1e5 };
            let (class, trial) = corpus::ray(&mut rng, &shape, size, reach);
            let span = computed_span(&shape, trial.origin, trial.direction);
            if span.enter < span.exit && span.exit > 0.0 { hits += 1; }
            let r = trial.roundings(span);
            let e = worst.entry(class).or_insert((0.0, None, 0));
            e.2 += 1;
            if r > e.0 { *e = (r, Some((trial, span)), e.2); }
        }
        println!("{name}: hits {hits}");
        for (c, (r, t, k)) in worst { println!("   {c:?} n={k} {r}"); if r > 16.0 { println!("      {t:?} exact {:?}", t.map(|(t,_)| t.exact_span().map(|(a,b)|(a.to_f64(), b.to_f64())))); } }
    }
}
