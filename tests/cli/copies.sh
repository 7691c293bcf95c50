#!/bin/sh
# Copies: four files with the same samples but other names and headers give the tables of one file, to the
# last digit. With --conditioning keep they do not.
# Usage: copies.sh WEARTRACK FIXTURES CURVE WORK. SPDX-License-Identifier: GPL-3.0-or-later
weartrack=$1
fixtures=$2
curve=$3
work=$4
failed=0

fail()
{
    echo "copies.sh: $1" >&2
    failed=1
}

# compare TABLES SUBCOMMAND OPTIONS... : the tables of x0 against those of x0 to x3.
compare()
{
    tables=$1
    shift
    (cd "$work/four" && "$weartrack" "$@" --no-provenance x0 -o one.tsv 2>one.txt) || fail "$1: one file"
    (cd "$work/four" && "$weartrack" "$@" --no-provenance x0 x1 x2 x3 -o four.tsv 2>four.txt) ||
        fail "$1: four files"
    (cd "$work/four" && "$weartrack" "$@" --no-provenance --conditioning keep x0 x1 x2 x3 -o keep.tsv \
        2>keep.txt) || fail "$1: four files that are kept"
    grep -q 'a copy, left out' "$work/four/four.txt" || fail "$1: no line about the copies"
    for table in $tables; do
        for of in one four keep; do
            "$weartrack" table "$work/four/$of.tsv" "$table" >"$work/four/$of-table.tsv" ||
                fail "$1: no table $table of $of"
        done
        cmp "$work/four/one-table.tsv" "$work/four/four-table.tsv" || fail "$1: $table changes"
        cmp -s "$work/four/one-table.tsv" "$work/four/keep-table.tsv" && fail "$1: keep changes no $table"
        count=$("$weartrack" table "$work/four/four.tsv" data_quality | grep -c 'copied	1	the same samples')
        [ "$count" -eq 3 ] || fail "$1: $count of 3 copies in data_quality"
    done
}

# copy FILE : makes x0 and three with another first line.
copy()
{
    rm -rf "$work/four"
    mkdir -p "$work/four"
    cp "$1" "$work/four/x0"
    for i in 1 2 3; do
        { echo "## note: exported again, $i" && cat "$work/four/x0"; } >"$work/four/x$i"
    done
}

copy "$curve"
compare "sensitivity sensitivity_curves" sensitivity --direction approach --max-slope-change 5

exit $failed
