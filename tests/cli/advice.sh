#!/bin/sh
# Follows the advice of messages: each row causes a message, follows its advice literally, and checks that
# it helps. Every message that names an option, a subcommand or an element of a case needs a row
# (advice.awk lists them).
# Usage: advice.sh WEARTRACK SOURCE FIXTURES WORK NAME, for the rows of advice/NAME.sh. The name "pieces"
# checks that every message has a row and every row a message.
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 source=$2 fixtures=$3 work=$4 rows=$5
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"; mkdir -p "$work"; cd "$work"
: > keys; : > mentions; : > unmade
failed=0 followed=0
fail() { printf '%s: %s\n    %s\n' "$message" "$*" "$(cat said)"; failed=$((failed + 1)); }

# piece TEXT...: the row tests the messages of the source that contain these texts
piece() { message=$1; printf '%s\n' "$@" >> keys; }
# not_advice TEXT REASON: the text only mentions an option, a subcommand or an element
not_advice() { printf '%s\n' "$1" >> keys; printf '%s\n' "$1" >> mentions; }
# no_input TEXT REASON: no small input causes the message
no_input() { printf '%s\n' "$1" >> keys; printf '%s\n' "$1" >> unmade; }

call() {
  status=0
  timeout 50 "$weartrack" "$@" > out 2> err < /dev/null || status=$?
  # joins the output to one line of text
  cat err out | grep -vE '^## (command|input)' | tr -s ' \n' '  ' > said
  [ "$status" -lt 124 ] || fail "$*: ended with $status"
}
# cause ADVICE ARGUMENT...: the call prints the advice
cause() {
  advice=$1; shift
  call "$@"
  grep -qF -e "$advice" said || fail "$*: does not say '$advice'"
}
# helps ARGUMENT...: the call that follows the advice gives a result
helps() {
  followed=$((followed + 1)); call "$@"
  case $status in 0 | 3) ;; *) fail "$*: exit status $status" ;; esac
  ! grep -qF -e "$advice" said || fail "$*: the same advice again"
}
# leads ARGUMENT...: the call is accepted and has a different message
leads() {
  followed=$((followed + 1)); call "$@"
  [ "$status" != 2 ] || fail "$*: is no call"
  ! grep -qE 'unknown option|no subcommand|no option .* any more' said || fail "$*: is refused"
  ! grep -qF -e "$advice" said || fail "$*: the same advice again"
}
# says REGEX: the last call printed a line with it
says() { grep -qE -e "$1" out err || fail "nothing printed like '$1'"; }
# number TABLE COLUMN VALUE TOLERANCE FILE: first value of a column, relative tolerance
number() {
  "$weartrack" table "$5" "$1" --format csv > column.csv 2> err || fail "no table $1"
  awk -F, -v name="$2" -v want="$3" -v within="$4" '
    NR == 1 { for (i = 1; i <= NF; i++) { n = $i; sub(/\[.*/, "", n); if (n == name) c = i } }
    NR == 2 { got = $c; off = got / want - 1; exit !(c && off * off <= within * within) }' \
    column.csv || fail "$2 of $1 is not $3"
}

if [ "$rows" != pieces ]; then
  . "$here/advice/files.sh"
  . "$here/advice/$rows.sh"
  echo "$followed calls followed the advice, $failed failures"
  [ "$failed" = 0 ]
  exit
fi

# The rows without their calls.
set +e
weartrack=true
call() { :; }; cause() { :; }; helps() { :; }; leads() { :; }; says() { :; }; number() { :; }; fail() { :; }
for file in "$here"/advice/files.sh "$here"/advice/*.sh; do . "$file"; done 2> /dev/null
# A message over several lines is found; help and comments are not messages.
cat > planted.c <<'END'
/* "give --comment 1" */ wt_error_advice(err, "give " ADVICE
                                         "the thing with --planted 1");
{.help = "as --helped 1"},
END
awk -f "$here/advice/advice.awk" planted.c > pieces
grep -q 'give .*--planted 1$' pieces && [ "$(wc -l < pieces)" = 1 ] || { cat pieces; failed=1; }
find "$source/src" -name '*.[ch]' | sort | xargs awk -f "$here/advice/advice.awk" > pieces
sort -u keys > keys.sorted
awk -F '\t' '
  FNR == NR { key[++n] = $0; next }
  { found = 0
    for (i = 1; i <= n; i++) if (index($2, key[i])) { used[i] = 1; found = 1 }
    if (!found) { print "no row for the advice of " $1 ": " $2; bad = 1 } }
  END {
    for (i = 1; i <= n; i++) if (!used[i]) { print "no message has the text of the row: " key[i]; bad = 1 }
    exit bad }' keys.sorted pieces || failed=$((failed + 1))
echo "$(wc -l < pieces) messages name an option, a subcommand or an element:" \
  "$(grep -c . mentions) texts only mention one, $(grep -c . unmade) cannot be caused"
[ "$failed" = 0 ]
