//! The fibre models and the optics they share against reference values that were computed independently
//! (`reference/values_fibres.py`): every record is asked for by its id, or its absence has a reason.

mod checks;
mod models;
mod records;

/// Records that nothing here asks for: the beginning of their ids, how many there are, and why.
const ELSEWHERE: [(&str, usize, &str); 1] =
    [("highlight.sphere", 2, "where highlights lie on a sphere is a question to a picture")];

#[test]
#[allow(clippy::print_stdout, reason = "the count is the test's report")]
fn every_record_is_asked_for_and_holds() {
    let mut asked: Vec<&str> = checks::all();
    asked.extend(models::all());
    let mut unused = records::ids();
    let all = unused.len();
    unused.retain(|id| !asked.contains(id));
    println!("{} of {all} records hold", all - unused.len());
    for (prefix, count, why) in ELSEWHERE {
        let before = unused.len();
        unused.retain(|id| !id.starts_with(prefix));
        println!("{count} records {prefix}* are not asked for here: {why}");
        assert_eq!(before - unused.len(), count, "records {prefix}*");
    }
    assert!(unused.is_empty(), "nobody asks for {unused:?}");
}
