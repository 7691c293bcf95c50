#!/bin/sh
# Damaged files (damage.h) as input of the commands. No command may crash, hang or be stopped by a
# sanitizer, and its output fits its exit status. If rows or numbers differ from the undamaged file with
# exit status 0 or 3, there is a warning that the undamaged file does not cause. This holds for the stated
# KINDS of damage. A number that was changed cannot be detected; such files are counted.
#
#   damaged_commands.sh DAMAGED_FILES COMMAND FOLDER SEED TRIALS KINDS "CALL" FILE
#
# KINDS: deleted,cut,... or none. CALL is a subcommand with its options. WT_DAMAGES in the environment
# replaces the number of trials. An archive has no central directory, which is reported and gives exit
# status 3.
#
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
damaged=$1 command=$2 folder=$3 seed=$4 trials=${WT_DAMAGES:-$5} kinds=$6 call=$7 file=$8
name=$(basename "$file")
rm -rf "$folder"
mkdir -p "$folder/files" "$folder/run" || exit 2
# The name is always the same, so that only the damage makes a difference. $folder/table receives the
# result without messages and image names, $folder/said the messages.
run() { # FILE
  cp "$1" "$folder/run/$name" || exit 2
  # shellcheck disable=SC2086 # the options are several words
  timeout 30 "$command" $call --no-provenance "$folder/run/$name" >"$folder/answer" 2>"$folder/said"
  status=$?
  awk '/^## table: / { notes = $0 ~ /notes$/ } !notes && !/^##( image:|$)/' "$folder/answer" >"$folder/table"
}
"$damaged" "$seed" "$trials" "write=$folder/files" "$file" || exit 1
run "$folder/files/whole-$name"
[ $status -eq 0 ] || [ $status -eq 3 ] || { cat "$folder/said"; echo "$file is not answered as it is"; exit 1; }
mv "$folder/table" "$folder/whole"
mv "$folder/said" "$folder/whole-said"
rm "$folder/files/whole-$name"
n=0 answered=0 told=0 silent=0 bad=0
for one in "$folder/files"/*; do
  run "$one"
  n=$((n + 1))
  if [ $status -gt 3 ] || grep -q "Sanitizer\|runtime error" "$folder/said" ||
    { [ $status -ne 0 ] && [ ! -s "$folder/said" ]; }; then
    echo "exit status $status: $call $one"
    head -5 "$folder/said"
    bad=$((bad + 1))
  elif [ $status -eq 0 ] || [ $status -eq 3 ]; then
    answered=$((answered + 1))
    cmp -s "$folder/table" "$folder/whole" && continue
    if grep -qvxFf "$folder/whole-said" "$folder/said"; then
      told=$((told + 1))
      continue
    fi
    silent=$((silent + 1))
    kind=$(basename "$one" | cut -d- -f2)
    case ,$kinds, in *,"$kind",*) bad=$((bad + 1)) && mark="must be said" ;; *) mark="" ;; esac
    echo "other numbers and no word: $call $one $mark"
  fi
done
echo "$call $file: $n damaged, $answered answered, of them $told otherwise and said, $silent not said; $bad bad"
[ "$n" -eq "$trials" ] && [ "$answered" -gt 0 ] && [ $bad -eq 0 ]
