#!/bin/sh
# Damaged files (damaged_files.c) through the commands that fit what is in them: none may crash, hang
# or be stopped by a sanitizer, and what it does ends as one of the four exit statuses says.
#
#   damaged_commands.sh DAMAGED_FILES COMMAND FOLDER SEED TRIALS indent|spot|master|psd FILE
#
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
damaged=$1 command=$2 folder=$3 seed=$4 trials=$5 which=$6 file=$7
tip="--tip pyramid:half-angle=20deg,radius=20nm"
case $which in
indent) options="$tip --spring-constant 0.3N/m --sensitivity 80nm/V" ;;
spot) options="$tip --depth 50nm" ;;
master | psd) options= ;;
esac
rm -rf "$folder"
mkdir -p "$folder" || exit 2
n=0 answered=0 bad=0
# shellcheck disable=SC2086 # the options are several words
"$command" "$which" -q $options "$file" >/dev/null || { echo "$file is not answered as it is"; exit 1; }
"$damaged" "$seed" "$trials" "write=$folder" "$file" || exit 1
for one in "$folder"/*; do
  # shellcheck disable=SC2086
  timeout 60 "$command" "$which" -q $options "$one" >/dev/null 2>"$folder.said"
  status=$?
  n=$((n + 1))
  { [ $status -eq 0 ] || [ $status -eq 3 ]; } && answered=$((answered + 1))
  if [ $status -gt 3 ] || grep -q "Sanitizer\|runtime error" "$folder.said" ||
    { [ $status -ne 0 ] && [ ! -s "$folder.said" ]; }; then
    echo "exit status $status: $which $one"
    head -5 "$folder.said"
    bad=$((bad + 1))
  fi
done
echo "$which $file: $n damaged, $answered answered, $bad bad"
[ "$n" -eq "$trials" ] && [ "$answered" -gt 0 ] && [ $bad -eq 0 ]
