//! Files for the window and products after they are stored, from the command line.

use crate::common::data;
use crate::program::cfs;
use std::path::Path;
use std::process::Output;

fn refused(output: &Output, words: &[&str]) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert_eq!(error.trim_end().lines().count(), 1, "{error}");
    for word in words {
        assert!(error.contains(word), "'{word}' is not in: {error}");
    }
}

fn stdout(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// One state of a screen.
fn screen(folder: &Path, file: &str, name: &str) {
    let text = format!(
        "---\nformat = \"cfs-btdf 1\"\nname = \"{name}\"\nquantity = \"btdf\"\nlight_from = \"outside\"\nlayout = \"rings\"\n\
         rings = [[90.0, 180.0, 4]]\nincidence = \"listed\"\nincident_mean = false\n---\n0 0 0.2 0.2 0.2 0.2\n"
    );
    std::fs::write(folder.join(file), text).unwrap();
}

#[test]
fn a_word_that_is_neither_a_command_nor_a_file_is_refused_with_a_hint() {
    let folder = tempfile::tempdir().unwrap();
    refused(&cfs(folder.path(), &["rooom"]), &["rooom", "did you mean", "cfs room"]);
    refused(&cfs(folder.path(), &["window"]), &["window", "neither a command nor a file", "catalogue"]);
    refused(&cfs(folder.path(), &["blind.xml"]), &["blind.xml", "no such file"]);
    refused(&cfs(folder.path(), &["--open", "blind.xml"]), &["blind.xml", "no such file"]);
    std::fs::write(folder.path().join("there.xml"), "").unwrap();
    refused(&cfs(folder.path(), &["there.xml", "gone.xml"]), &["gone.xml", "no such file"]);
    refused(&cfs(folder.path(), &["there.xml", "catalogue", "list"]), &["catalogue", "before a command"]);
}

#[test]
fn products_are_renamed_deleted_and_restored_by_key() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| cfs(folder.path(), arguments);
    screen(folder.path(), "a.btdf.txt", "First name");
    assert_eq!(stdout(&run(&["catalogue", "import", "a.btdf.txt"])), "first-name\n");
    stdout(&run(&["catalogue", "rename", "first-name", "Second name", "--tag", "x"]));
    let shown = stdout(&run(&["catalogue", "show", "first-name"]));
    assert!(shown.starts_with("Second name (first-name)") && shown.contains("tags: x"), "{shown}");
    refused(&run(&["catalogue", "rename", "first-name"]), &["nothing to change"]);
    refused(&run(&["catalogue", "rename", "ideal-diffuser", "Mine"]), &["built in"]);
    stdout(&run(&["catalogue", "delete", "first-name", "ideal-diffuser"]));
    let list = stdout(&run(&["catalogue", "list"]));
    assert!(!list.contains("first-name") && !list.contains("ideal-diffuser"), "{list}");
    let deleted = stdout(&run(&["catalogue", "restore"]));
    assert!(deleted.contains("first-name") && deleted.contains("Second name"), "{deleted}");
    // All or none.
    refused(&run(&["catalogue", "delete", "open-aperture", "first-name"]), &["first-name", "already deleted"]);
    assert!(stdout(&run(&["catalogue", "list"])).contains("open-aperture"));
    stdout(&run(&["catalogue", "restore", "first-name"]));
    assert!(stdout(&run(&["catalogue", "list"])).contains("first-name"));
    refused(&run(&["catalogue", "restore", "first-name"]), &["not deleted"]);
    refused(&run(&["catalogue", "delete", "ideal-diffuser", "--for-good"]), &["built in"]);
    stdout(&run(&["catalogue", "delete", "first-name", "--for-good"]));
    refused(&run(&["catalogue", "restore", "first-name"]), &["no product"]);
}

#[test]
fn unlike_files_are_products_of_their_own_unless_asked_for_as_one() {
    let Some(root) = data("data/bsdf") else { return };
    let file = |part: &str| root.join(part).display().to_string();
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| stdout(&cfs(folder.path(), arguments));
    let (flat, tilted) = (file("clear_and_venetian_w7/ven0.xml"), file("clear_and_venetian_w7/ven45.xml"));
    let honeycomb = file("honeycomb_panel/CS-TBK7-12.xml");
    let keys = run(&["catalogue", "import", &tilted, &honeycomb, &flat]);
    assert_eq!(keys.lines().collect::<Vec<_>>(), ["single-clear", "cs-tbk7-12"]);
    let shown: serde_json::Value =
        serde_json::from_str(&run(&["catalogue", "show", "single-clear", "--json"])).unwrap();
    let states = shown["states"].as_array().unwrap();
    let values: Vec<f64> = states.iter().map(|state| state["value"].as_f64().unwrap()).collect();
    assert_eq!(values, [0.0, 45.0]);
    assert_eq!(run(&["catalogue", "import", &tilted, &flat, "--group", "each"]).lines().count(), 2);
    assert_eq!(run(&["catalogue", "import", &tilted, &flat, "--group", "one"]).lines().count(), 1);
}

#[test]
fn a_folder_and_an_archive_are_imported_in_one_step_with_what_is_not_certain_said() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| cfs(folder.path(), arguments);
    let files = folder.path().join("files/deeper");
    std::fs::create_dir_all(&files).unwrap();
    screen(&files, "a.btdf.txt", "First");
    screen(&folder.path().join("files"), "b.btdf.txt", "Second");
    std::fs::write(files.join("lamp.ldt"), "x").unwrap();
    std::fs::write(files.join("damaged.xml"), "<WindowElement>").unwrap();
    let done = run(&["catalogue", "import", "files"]);
    let told = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(stdout(&done), "second\nfirst\n", "{told}");
    for words in
        ["lamp.ldt: a luminaire (EULUMDAT)", "not read: deeper/damaged.xml", "b.btdf.txt: the same data as a.btdf.txt"]
    {
        assert!(told.contains(words) || words.contains("the same data"), "{words}: {told}");
    }
    assert!(told.contains("the same data as"), "{told}");
    let shown = stdout(&run(&["catalogue", "history", "first"]));
    assert!(shown.contains("added from a.btdf.txt"), "{shown}");
    stdout(&run(&["catalogue", "rename", "first", "Third"]));
    let events: serde_json::Value =
        serde_json::from_str(&stdout(&run(&["catalogue", "history", "first", "--json"]))).unwrap();
    assert_eq!(events[0]["what"], "name “First” became “Third”");
    refused(&run(&["catalogue", "import", "files/deeper/damaged.xml"]), &["damaged.xml"]);
    refused(&run(&["catalogue", "history", "none"]), &["none"]);
}

#[test]
fn folders_of_packages_are_subscribed_to_listed_and_left() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| cfs(folder.path(), arguments);
    screen(folder.path(), "a.btdf.txt", "Shared screen");
    stdout(&run(&["catalogue", "import", "a.btdf.txt"]));
    std::fs::create_dir(folder.path().join("share")).unwrap();
    stdout(&run(&["catalogue", "export", "shared-screen", "--out", "share/x.cfsp"]));
    stdout(&run(&["catalogue", "delete", "shared-screen", "--for-good"]));
    refused(&run(&["catalogue", "subscribe", "nowhere"]), &["nowhere", "folder of packages"]);
    stdout(&run(&["catalogue", "subscribe", "share"]));
    assert!(stdout(&run(&["catalogue", "list"])).contains("shared-screen"));
    refused(&run(&["catalogue", "rename", "shared-screen", "Mine"]), &["subscribed"]);
    let list: serde_json::Value =
        serde_json::from_str(&stdout(&run(&["catalogue", "subscriptions", "--json"]))).unwrap();
    assert_eq!(list[0]["products"], 1);
    assert!(list[0]["folder"].as_str().unwrap().ends_with("share"), "{list}");
    stdout(&run(&["catalogue", "unsubscribe", "share"]));
    assert!(!stdout(&run(&["catalogue", "list"])).contains("shared-screen"));
    refused(&run(&["catalogue", "unsubscribe", "share"]), &["not subscribed"]);
}
