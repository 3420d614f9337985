#![allow(clippy::all, clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]
fn main() {
    let (file, _) =
        motion_io::library_file::LibraryFile::load(std::path::Path::new("/tmp/cmu2.gwlib"))
            .unwrap();
    for id in ["127_24", "02_05", "135_04"] {
        let c = file.clips.by_id(id).unwrap();
        println!(
            "{id} frames {} dead_from {} ; tau dead {}",
            file.clips.clip(c).n_frames(),
            file.graph.with_bridges.dead_from[c.idx()],
            file.graph.by_tau.dead_from[c.idx()]
        );
        let f = &file.graph.forest;
        let mut n = 0;
        let mut lo = (u32::MAX, 0);
        let mut entries = vec![];
        for p in f.pairs_from(c) {
            for e in
                file.graph.leaf_edges(p.from, p.to).iter().chain(&file.graph.bridges(p.from, p.to))
            {
                n += 1;
                lo = (lo.0.min(e.from_frame.0), lo.1.max(e.from_frame.0));
            }
        }
        for p in f.pairs() {
            if p.to == c && p.from != c {
                for e in file
                    .graph
                    .leaf_edges(p.from, p.to)
                    .iter()
                    .chain(&file.graph.bridges(p.from, p.to))
                {
                    entries.push((
                        e.to_frame.0,
                        file.clips.clip(p.from).id.clone(),
                        e.from_frame.0,
                        e.cost,
                    ));
                }
            }
        }
        entries.sort_by_key(|e| e.0);
        println!(
            "  out {n} from {lo:?}; in {} first {:?}",
            entries.len(),
            &entries[..entries.len().min(8)]
        );
    }

    // Earliest frames reachable from a root, and the time to 135_04@150.
    let g = &file.graph;
    let target = file.clips.by_id("135_04").unwrap();
    let n = g.n_clips();
    let mut d: Vec<Vec<u32>> = (0..n).map(|c| vec![u32::MAX; g.clip_frames[c] as usize]).collect();
    for f in 0..=150 {
        d[target.idx()][f] = 150 - f as u32;
    }
    for _hop in 0..12 {
        for p in g.forest.pairs() {
            for e in g.leaf_edges(p.from, p.to).iter().chain(&g.bridges(p.from, p.to)) {
                let v = d[p.to.idx()][e.to_frame.idx()];
                let x = &mut d[p.from.idx()][e.from_frame.idx()];
                if v < *x {
                    *x = v;
                }
            }
        }
        for c in 0..n {
            for f in (0..d[c].len() - 1).rev() {
                d[c][f] = d[c][f].min(d[c][f + 1].saturating_add(1));
            }
        }
        let a = file.clips.by_id("02_05").unwrap();
        println!("hop: from 02_05@121 {}", d[a.idx()][121]);
    }
    let mut few: Vec<(u32, String, u32)> = vec![];
    for p in g.forest.pairs() {
        if p.to == target && p.from != target {
            let v: Vec<_> = g
                .leaf_edges(p.from, p.to)
                .into_iter()
                .chain(g.bridges(p.from, p.to))
                .filter(|e| e.to_frame.0 <= 150)
                .collect();
            if !v.is_empty() {
                few.push((
                    v.len() as u32,
                    file.clips.clip(p.from).id.clone(),
                    v.iter().map(|e| e.from_frame.0).max().unwrap(),
                ));
            }
        }
    }
    few.sort();
    println!("{few:?}");

    for id in ["135_07", "135_04"] {
        let c = file.clips.by_id(id).unwrap();
        let mut few = vec![];
        for p in g.forest.pairs() {
            if p.to == c && p.from != c {
                let v: Vec<_> =
                    g.leaf_edges(p.from, p.to).into_iter().chain(g.bridges(p.from, p.to)).collect();
                few.push((
                    v.len(),
                    file.clips.clip(p.from).id.clone(),
                    v.iter().map(|e| (e.from_frame.0, e.to_frame.0)).take(5).collect::<Vec<_>>(),
                ));
            }
        }
        println!("{id} <- {few:?}");
    }
}
