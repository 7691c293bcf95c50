# Records of friction, surfaces, layer. SPDX-License-Identifier: GPL-3.0-or-later

disc=$fixtures/record/disc.csv
# record SECONDS COLUMNS: a steady friction force with some scatter
steady() { awk -v with="$1" 'BEGIN { srand(1); for (i = 0; i < 400; i++) {
  f = 5 + 0.1 * rand(); printf "%.2f", i * 0.1
  if (with ~ /load/) printf ",5"
  if (with ~ /rotation/) printf ",60"
  if (with ~ /distance/) printf ",%.4f", i * 0.01
  if (with ~ /laps/) printf ",%.4f", i * 0.1
  printf ",%.4f\n", f } }'; }
piece 'give the load: weartrack record --load 5N'
cause 'weartrack record --load 5N' record "$disc" -o a.h5
helps record --load 5N "$disc" -o record.h5
number record friction_coefficient 0.8 0.05 record.h5
piece 'velocity not known: give --track-radius'
{ echo 'time (s),normal force (N),rotation (rpm),friction force (N)'; steady load,rotation; } > turns.csv
cause 'velocity not known: give --track-radius' record turns.csv -o -
helps record --track-radius 12mm turns.csv -o -
piece 'weartrack record --track-radius 10mm' '--track-radius 10mm'
{ echo 'time (s),normal force (N),friction torque (N mm)'; steady load; } > torque.csv
cause 'weartrack record --track-radius 10mm' record torque.csv -o -
helps record --track-radius 10mm torque.csv -o torque.h5
number record friction_coefficient 0.101 0.01 torque.h5
call info torque.csv
says '^next: weartrack record .*--track-radius 10mm'
piece 'no distance: give --track-radius' 'the loss of the track is not known: give --profile, --track-area or --mass-loss' 'no load: give --load'
{ echo 'time (s),normal force (N),friction force (N)'; steady load; } > still.csv
cause 'no distance, velocity, laps or rotation in the record' record --track-area 3e-11m^2 still.csv -o -
cause 'no distance: give --track-radius' record --track-area 3e-11m^2 turns.csv -o -
helps record --track-area 3e-11m^2 --track-radius 12mm turns.csv -o wear.h5
cause 'the loss of the track is not known' record --track-radius 12mm --ball-radius 5mm --modulus 20MPa turns.csv -o -
helps record --track-radius 12mm --mass-loss 3mg --density 1150kg/m^3 turns.csv -o -
{ echo 'time (s),distance (m),mu'; steady distance | sed 's/,\([^,]*\)$/,0.9/'; } > mu.csv
cause 'no load: give --load' record --track-area 3e-11m^2 --track-radius 12mm mu.csv -o -
helps record --load 5N --track-area 3e-11m^2 --track-radius 12mm mu.csv -o -
piece 'treated as that of a disc; if it is not' 'no volume: give --track-length or --track-radius'
{ echo 'time (s),normal force (N),distance (m),laps,friction force (N)'; steady load,distance,laps; } > laps.csv
cause 'give its length with --track-length' record --track-area 3e-11m^2 laps.csv -o -
helps record --track-area 3e-11m^2 --track-length 100mm laps.csv -o -
{ echo 'time (s),normal force (N),distance (m),friction force (N)'; steady load,distance; } > path.csv
cause 'no volume: give --track-length or --track-radius' record --track-area 3e-11m^2 path.csv -o -
helps record --track-area 3e-11m^2 --track-radius 12mm path.csv -o -
helps record --track-area 3e-11m^2 --track-length 75mm path.csv -o -
{ echo 'time (s),normal force (N),friction force (N)'; awk 'BEGIN { for (i = 0; i < 400; i++) printf "%.2f,5,%.3f\n", i * 0.1, (int(i / 20) % 2 ? -5 : 5) + 0.01 * (i % 7) }'; } > strokes.csv
piece 'no distance: give --track-length' 'no volume: give --track-length'
cause 'no distance: give --track-length' record --track-area 3e-11m^2 strokes.csv -o -
helps record --track-area 3e-11m^2 --track-length 10mm strokes.csv -o -
piece 'column \"%s\" is not read: the file does not say its unit'
{ echo 'time (s),load,friction force (N)'; steady load; } > unit.csv
cause 'give it with --units' record unit.csv -o -
helps record --units load=N unit.csv -o -
piece 'what weartrack record wrote' 'give what weartrack record wrote'
cause 'what weartrack record wrote' record three.h5
helps record record.h5 -o a.h5

piece 'give --end, or leave both out'
cause 'give --end' psd --end-slope 1e6 "$road"
helps psd --end 2e6rad/m "$road" -o a.h5
helps psd "$road" -o a.h5
piece '--scan-lines keep' '(--scan-lines keep leaves them)' '(--scan-lines keep leaves the offsets)'
{ printf '# Channel: Z\n# Width: 6.4 um\n# Height: 6.4 um\n# Value units: m\n'
  awk 'BEGIN { srand(2); for (i = 0; i < 64; i++) { o = 40e-9 * rand(); for (j = 0; j < 64; j++) {
    z = 1e-7 * sin(i / 9) * sin(j / 7) + o + (i == 30 && j > 8 && j < 50 ? 5e-7 : 0)
    printf "%.4e%s", z, j < 63 ? "\t" : "\n" } } }'; } > lines.txt
cause '(--scan-lines keep leaves the' psd lines.txt -o a.h5
helps psd --scan-lines keep lines.txt -o a.h5
piece '--roughness self-affine:q0=%.6grad/m'
law=$("$weartrack" psd "$road" 2> err | tr '\t' '\n' | grep -o 'self-affine:q0[^ "]*' | head -n 1)
[ -n "$law" ] || fail 'psd tells no law'
advice='no such text'
helps friction --material three.h5 --roughness "$law" --pressure 0.4MPa --velocity 0.1m/s

# indentation positions
piece 'its coordinates in the image would decide (--at-x, --at-y)' 'a better known position would decide (--position-error)'
cause '(--at-x, --at-y)' spot --tip sphere:radius=5um --depth 500nm --at-x 1m --at-y 1m "$road"
helps spot --tip sphere:radius=5um --depth 500nm --at-x 0m --at-y 0m "$road"
