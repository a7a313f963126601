//! prototype
use gsdf_tests::accuracy::*;
fn main() {
    let rays: u64 = std::env::args().nth(1).unwrap().parse().unwrap();
    for cell in Cell::all() {
        let t = std::time::Instant::now();
        let m = cell.measure(0..rays, [0.0; 3]);
        print!("{:16} {:16} asked {:5.2}% {:6.2}us", gsdf_tests::shape::KINDS[cell.leaf], cell.corpus.name(), 100.0*m.asked as f64/rays as f64, t.elapsed().as_secs_f64()*1e6/rays as f64);
        for a in cell.arithmetics() { let s=&m.statistics[a as usize]; print!(" | {:.4} {:.3e} {:.3e} {:.2}({})", 100.0*s.wrong_share(), s.p99(), s.most.error, s.conditioned.error, s.conditioned.ray); }
        println!();
    }
}
