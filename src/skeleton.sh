#!/bin/sh
# Writes the skeleton of a binary reader or of a subcommand, with its rows in the lists.
#
#   src/skeleton.sh reader ID          ID: lower-case letters and digits, such as gsf
#   src/skeleton.sh subcommand NAME    NAME: lower-case letters and hyphens, such as new-case
#
# The new files compile. The script changes nothing if the name exists. Exit status: 0 written,
# 1 nothing written, 2 usage. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
LC_ALL=C
export LC_ALL
kind=${1-} id=${2-}
top=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  sed -n '2,/SPDX/s/^# \{0,1\}//p' "$0" >&2
  exit 2
}

refuse() {
  echo "skeleton.sh: $*; nothing was written" >&2
  exit 1
}

# Writes the standard input to a new file of the source tree.
create() { # PATH
  mkdir -p "$(dirname "$top/$1")"
  sed "s/@ID@/$id/g; s/@C@/$c_name/g; s/@UPPER@/$upper/g" >"$top/$1"
  echo "new:     $1"
}

# Replaces a file of the source tree by the output of awk on it. The row must be there afterwards.
change() { # PATH ROW PROGRAM
  awk -v row="$2" "$3" "$top/$1" >"$top/$1.new"
  cat "$top/$1.new" >"$top/$1"
  rm "$top/$1.new"
  grep -qF -- "$2" "$top/$1" || {
    echo "skeleton.sh: $1: no place found for \"$2\"; add it by hand" >&2
    exit 1
  }
  echo "changed: $1 (+ $2)"
}

reader() {
  case $id in
  [a-z]*) ;;
  *) usage ;;
  esac
  [ -z "$(printf %s "$id" | tr -d a-z0-9)" ] || refuse "ID \"$id\": only a-z and 0-9 are allowed"
  [ "${#id}" -le 16 ] || refuse "ID \"$id\": more than 16 characters"
  grep -q "^READER($id)" "$top/src/read/readers.def" && refuse "readers.def has a reader \"$id\""
  grep -rqE "\.id = \"$id\"" "$top/src/read" && refuse "a reader has the id \"$id\""
  for place in "src/read/$id" "formats/$id.xml" "fixtures/fuzz/$id"; do
    [ ! -e "$top/$place" ] || refuse "$place exists"
  done

  create "src/read/$id/$id.c" <<'END'
/* Reads @UPPER@ files (.@ID@): TODO: instrument or program, and the source of the layout.
 *
 * TODO: the layout. This skeleton reads a signature, the numbers of columns and rows as
 * little-endian 32-bit integers, and little-endian floats in metres, the top line first.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/bytes.h"
#include "read/bytes/samples.h"
#include "read/images.h"
#include "read/reader.h"

static const char signature[] = "@ID@-skeleton\n";
enum { SIGNATURE_LENGTH = sizeof signature - 1, HEADER_LENGTH = SIGNATURE_LENGTH + 8 };

static wt_status read_header(input_window *window, wt_image *head, wt_error *err)
{
    const unsigned char *bytes = NULL;
    const wt_status status = window_bytes(window, 0, HEADER_LENGTH, &bytes, err);
    if (status != WT_OK)
        return status;
    *head = (wt_image){.n_columns = le32(bytes + SIGNATURE_LENGTH),
                       .n_rows = le32(bytes + SIGNATURE_LENGTH + 4),
                       .unit = "m",
                       .x_unit = "m"};
    /* No product overflows, because each length has 32 bits and size_t has 64. */
    if (head->n_columns == 0 ||
        (window->size - HEADER_LENGTH) / 4 / head->n_columns < head->n_rows) {
        wt_fail(err, WT_E_CORRUPT, "the size of the file contradicts its header");
        wt_error_expected(err, "four bytes for each of %zu x %zu pixels", head->n_columns,
                          head->n_rows);
        wt_error_found(err, "%zu bytes", window->size);
        return WT_E_CORRUPT;
    }
    images_set_name(head, "height");
    images_set_size(head, 1e-6, 1e-6); /* TODO: width and height of the area [m] */
    return WT_OK;
}

static wt_status read_images(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err)
{
    input_window window = {.input = NULL};
    image_list list = {NULL, 0};
    wt_image head = {.n_columns = 0};
    double *values = NULL;
    (void)self;
    (void)options;
    wt_status status = window_open(&window, input, err);
    if (status == WT_OK)
        status = read_header(&window, &head, err);
    if (status == WT_OK)
        status = images_add(&list, &head, &values, err);
    for (size_t row = 0; status == WT_OK && row < head.n_rows; row++) {
        const unsigned char *bytes = NULL;
        const size_t length = 4 * head.n_columns;
        status = window_bytes(&window, HEADER_LENGTH + row * length, length, &bytes, err);
        if (status == WT_OK) /* a wt_image begins with the bottom line */
            samples_decode(SAMPLE_FLOAT32, false, bytes, head.n_columns, 1, 0,
                           values + (head.n_rows - 1 - row) * head.n_columns);
    }
    window_close(&window);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(PEEK_BEGINS(peek, signature), 95);
}

const file_reader reader_@ID@ = {
    .info = {.id = "@ID@",
             .title = "@UPPER@ (.@ID@), TODO: instrument or program",
             .kinds = WT_KIND_IMAGE,
             .verified = false,
             .evidence = "TODO: how the numbers were verified",
             .version = "1"},
    .detect = detect,
    .read_images = read_images,
    .describe = images_describe,
};
END
  change src/read/readers.def "READER($id)" '
    !done && ((/^READER\(/ && $0 > row) || /^#undef READER/) { print row; done = 1 }
    { print }'
  change src/read/CMakeLists.txt "  $id/$id.c" '
    !done && /^  [a-z].*\.c\)?$/ {
      last = sub(/\)$/, "")
      if ($0 > row) { print row; done = 1 }
      else if (last) { print; $0 = row; done = 1 }
      if (last) $0 = $0 ")"
    }
    { print }'
  # two columns and two rows; every binary reader has a fuzz target, which begins with the seeds
  mkdir -p "$top/fixtures/fuzz/$id"
  printf '%s-skeleton\n\002\000\000\000\002\000\000\000' "$id" >"$top/fixtures/fuzz/$id/seed0.$id"
  printf '\137\160\211\060\137\160\011\061\050\224\116\061\137\160\211\061' \
    >>"$top/fixtures/fuzz/$id/seed0.$id" # 1 to 4 nm
  echo "new:     fixtures/fuzz/$id/seed0.$id"
  cat <<END

To do by hand:
 1. src/read/$id/$id.c: each TODO; the kinds of data that the files have (read/reader.h).
    A header besides those of the list in tests/arch/layers.cmake needs a row there: may_read/$id.
 2. tests/writers: a writer of such files; tests/fuzz/make_seeds.c: the seeds with it, in place of
    the seed of this script; fixtures/README.md: the origin of the seeds.
 3. tests/unit/test_read_*.c: a test with known values. No other test checks the numbers.
 4. tests/mutants/concerned: a row for src/read/$id/.
Try it: weartrack info fixtures/fuzz/$id/seed0.$id; ctest -R 'fuzz_$id|unit_read_detect|arch_layers'
END
}

subcommand() {
  case $id in
  [a-z]*[a-z] | [a-z]) ;;
  *) usage ;;
  esac
  [ -z "$(printf %s "$id" | tr -d a-z-)" ] || refuse "NAME \"$id\": only a-z and - are allowed"
  [ "${#id}" -le 11 ] || refuse "NAME \"$id\": more than 11 characters, the width in the help"
  [ "$id" != help ] || refuse "help is a subcommand already"
  grep -q "{\"$id\", cmd_" "$top/src/cmd/main.c" && refuse "main.c has a subcommand \"$id\""
  grep -qF " cmd_$c_name(" "$top/src/cmd/cmd.h" && refuse "cmd.h has a function cmd_$c_name"
  for place in "src/cmd/$c_name.c" "man/weartrack-$id.1"; do
    [ ! -e "$top/$place" ] || refuse "$place exists"
  done

  create "src/cmd/$c_name.c" <<'END'
/* weartrack @ID@: TODO: what it computes, from which files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

/* TODO: replace it by the exported function of the slice, which is declared in include/weartrack. A
 * subcommand has no formula and no parser. */
static wt_status compute(const wt_file_set *set, wt_job *work, wt_table **table, wt_error *err)
{
    (void)set;
    (void)work;
    *table = NULL;
    return wt_fail(err, WT_E_UNSUPPORTED, "this subcommand computes nothing yet");
}

int cmd_@C@(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "@ID@",
        .arguments = "[OPTION]... FILE...",
        .description = "TODO: what it computes, in a few lines. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .n_files = CMD_ONE_OR_MORE};
    wt_file_set set = {.read = wt_read_defaults()};
    /* TODO: {wt_NAME_job_params(), &job, NULL, 0} for the options of the job. */
    cmd_option_group parts[] = {{wt_read_params(), &set.read, "units format", 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL;
    wt_table **const tables[] = {&made};
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, compute(&set, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
END
  change src/cmd/cmd.h "int cmd_$c_name(int argc, char **argv);" '
    inside && !/^int cmd_/ { print row; inside = 0; done = 1 }
    { print }
    !done && /^int cmd_[a-z_]*\(int argc, char \*\*argv\);$/ { inside = 1 }'
  change src/cmd/main.c "    {\"$id\", cmd_$c_name, \"TODO: one line for the help\"}," '
    /^    \{NULL, NULL, NULL\}\};/ && !done { print row; done = 1 }
    { print }'
  change src/cmd/CMakeLists.txt "  $c_name.c" '
    { print }
    /^add_executable\(weartrack_command$/ { print row }'
  th=$(sed -n 's/^\.TH [^"]*"[^"]*" \(.*\)$/\1/p' "$top/man/weartrack-ramp.1")
  title=$(printf %s "$id" | tr a-z A-Z)
  create "man/weartrack-$id.1" <<END
.\\" SPDX-License-Identifier: GPL-3.0-or-later
.TH WEARTRACK-$title 1 "$(date +%Y-%m-%d)" $th
.SH NAME
weartrack-$id \\- TODO: one line
.SH SYNOPSIS
\\fBweartrack $id\\fR [\\fIOPTION\\fR]... \\fIFILE\\fR...
.SH DESCRIPTION
TODO: what it computes, its tables, and its limits.
.SH OPTIONS
.\\" options
.\\" end
.SH EXIT STATUS
0 whole, 1 nothing usable or a fault, 2 usage error, 3 answered in part.
.SH SEE ALSO
.BR weartrack (1)
END
  cat <<END

To do by hand:
 1. src/cmd/$c_name.c: each TODO, with the job of the slice and its options.
 2. src/cmd/main.c: the line of help, and the row in the group to which it belongs.
 3. src/cmd/CMakeLists.txt: put the file with those of its group.
 4. man/weartrack-$id.1: each TODO; then cmake --build build/release --target docs_write, which
    writes the options and the list in weartrack(1).
 5. tests/cli: a file of cases; README.md and CHANGELOG.md: a line each.
Try it: weartrack $id --help; ctest -R 'docs_|arch_|cli_usage'
END
}

[ $# -eq 2 ] || usage
c_name=$(printf %s "$id" | tr - _)
upper=$(printf %s "$id" | tr a-z A-Z)
case $kind in
reader | subcommand) "$kind" ;;
*) usage ;;
esac
