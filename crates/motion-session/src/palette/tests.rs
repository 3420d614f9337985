//! Check boxes: each click means exactly what it shows, whatever the palette was written like.

use super::*;

/// Ids with tags behind a colon; each with its mirror image.
fn library() -> Vec<(String, Vec<String>)> {
    let clip = |text: &&str| {
        let (id, tags) = text.split_once(':').unwrap();
        (id.to_owned(), tags.split(' ').map(str::to_owned).collect())
    };
    let clips =
        ["walk:walk", "walk_late:walk late", "run:run", "run_[1]:run odd", "Sit:sit", "16_1:walk"];
    let own: Vec<(String, Vec<String>)> = clips.iter().map(clip).collect();
    let image = |(id, tags): &(String, Vec<String>)| (format!("{id}@mirror"), tags.clone());
    let images: Vec<_> = own.iter().map(image).collect();
    own.into_iter().chain(images).collect()
}

fn tagged(library: &[(String, Vec<String>)]) -> Vec<TaggedClip<'_>> {
    library.iter().map(|(id, tags)| (id.as_str(), tags.as_slice())).collect()
}

fn palette(include: &[&str], exclude: &[&str], tags: &[&str]) -> Palette {
    let [include, exclude, tags] =
        [include, exclude, tags].map(|list| list.iter().map(|&s| s.to_owned()).collect());
    Palette { include, exclude, tags, extra: Default::default() }
}

fn written(palette: Option<&Palette>) -> String {
    let list = |list: &[String]| list.join(" ");
    palette.map_or("all".to_owned(), |p| {
        format!("{} - {} # {}", list(&p.include), list(&p.exclude), list(&p.tags)).trim().to_owned()
    })
}

/// What a click on one clip makes of a palette.
#[track_caller]
fn check(old: Option<Palette>, clip: &str, on: bool, expected: &str) {
    let library = library();
    let new = palette_with(old.as_ref(), &tagged(&library), clip, on);
    assert_eq!(written(new.as_ref()), expected, "{} with {clip} {on}", written(old.as_ref()));
}

#[test]
fn a_click_changes_as_little_as_it_can() {
    check(None, "run", false, "* - run #");
    check(Some(palette(&["*"], &["run"], &[])), "run", true, "all");
    check(Some(palette(&[], &[], &[])), "run", true, "all");
    check(Some(palette(&["*"], &["run", "Sit"], &[])), "run", true, "* - Sit #");
    check(Some(palette(&["walk*"], &[], &[])), "walk", false, "walk* - walk #");
    check(Some(palette(&["walk*"], &[], &[])), "run", true, "walk* run -  #");
    check(Some(palette(&["walk*", "run"], &[], &[])), "run", false, "walk* -  #");
    check(Some(palette(&["*"], &["walk*"], &[])), "walk", true, "* - walk_late #");
    check(Some(palette(&["*"], &[], &["walk"])), "walk", false, "* - walk # walk");
    check(None, "run_[1]", false, "* - run_[[]1[]] #");
    check(None, "run@mirror", false, "* - run@mirror #");
    check(Some(palette(&["*"], &["*@mirror"], &[])), "run", false, "* - *@mirror run #");
    check(Some(palette(&["sit"], &[], &[])), "Sit", false, "sit - Sit #");
}

/// The clips in a palette.
fn in_use(palette: Option<&Palette>, clips: &[TaggedClip<'_>]) -> Vec<bool> {
    clips.iter().map(|clip| is_in_palette(palette, *clip)).collect()
}

#[test]
fn every_click_on_every_palette_means_what_it_shows() {
    let library = library();
    let clips = tagged(&library);
    let lists: [&[&str]; 6] =
        [&[], &["*"], &["walk*"], &["run", "16_*"], &["*@mirror"], &["?????*", "walk"]];
    let tags: [&[&str]; 3] = [&[], &["walk"], &["late", "odd"]];
    for include in lists {
        for exclude in lists {
            for tags in tags {
                let old = palette(include, exclude, tags);
                let before = in_use(Some(&old), &clips);
                for id in ["walk", "run_[1]", "16_1@mirror"] {
                    for on in [true, false] {
                        let new = palette_with(Some(&old), &clips, id, on);
                        let after = in_use(new.as_ref(), &clips);
                        for (nth, (other, _)) in clips.iter().enumerate() {
                            let is_asked = *other == id || source_of(other) == id;
                            let expected = if is_asked { on } else { before[nth] };
                            let (old, new) = (written(Some(&old)), written(new.as_ref()));
                            assert_eq!(
                                after[nth], expected,
                                "{other}: {old} with {id} {on}: {new}"
                            );
                        }
                        assert_eq!(new.is_none(), !after.contains(&false));
                    }
                }
            }
        }
    }
}

#[test]
fn a_tag_is_all_its_clips() {
    let library = library();
    let clips = tagged(&library);
    assert_eq!(tag_state(None, &clips, "walk"), TagState::All);
    let without = palette_with_tag(None, &clips, "walk", false);
    assert_eq!(written(without.as_ref()), "* - 16_1 walk walk_late #");
    assert_eq!(tag_state(without.as_ref(), &clips, "walk"), TagState::None);
    assert_eq!(tag_state(without.as_ref(), &clips, "run"), TagState::All);
    let late = palette_with_tag(without.as_ref(), &clips, "late", true);
    assert_eq!(tag_state(late.as_ref(), &clips, "walk"), TagState::Some);
    assert_eq!(palette_with_tag(late.as_ref(), &clips, "walk", true), None);
}

#[test]
fn a_palette_that_the_search_refuses_has_no_clip_and_is_mended_by_a_click() {
    let library = library();
    let clips = tagged(&library);
    let broken = palette(&["*"], &["[", "run*"], &[]);
    assert!(!is_in_palette(Some(&broken), clips[0]));
    let mended = palette_with(Some(&broken), &clips, "walk", false);
    assert_eq!(written(mended.as_ref()), "* - run* walk #");
}

#[test]
fn keys_of_later_versions_stay() {
    let library = library();
    let mut old = palette(&["*"], &["run"], &[]);
    old.extra.insert("mood".to_owned(), serde_json::json!("fast"));
    let new = palette_with(Some(&old), &tagged(&library), "run", true).unwrap();
    assert_eq!(new.extra, old.extra);
}
