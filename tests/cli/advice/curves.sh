# Force curves, images of positions. SPDX-License-Identifier: GPL-3.0-or-later

volts=$fixtures/formats/table-force/volts.csv
piece '--spring-constant 0.1N/m' '--sensitivity 60nm/V'
cause '--spring-constant 0.1N/m' indent --tip "$tip" "$fixtures/formats/afm-workshop/curve.csv"
leads indent --tip "$tip" --spring-constant 0.1N/m --sensitivity 60nm/V "$fixtures/formats/afm-workshop/curve.csv"
cause '--sensitivity 60nm/V' indent --tip "$tip" "$volts"
leads indent --tip "$tip" --spring-constant 0.1N/m --sensitivity 60nm/V "$volts"
cause 'give --spring-constant 0.1N/m' info "$fixtures/formats/afm-workshop/curve.csv"
helps info --spring-constant 0.1N/m --sensitivity 60nm/V "$fixtures/formats/afm-workshop/curve.csv"
says '^next: weartrack indent .*--spring-constant 0.1N/m --sensitivity 60nm/V'
not_advice 'see what the file holds with: weartrack info FILE' 'of a segment that the readers never make'
no_input 'give it, e.g. --sensitivity 60nm/V' 'the library only: readers refuse such a file before'
no_input 'give it, e.g. --spring-constant 0.1N/m' 'the library only: readers refuse such a file before'

piece "Poisson's ratio of %g or more, or --unbonded"
cause '--unbonded' indent --tip sphere:radius=5um --poisson-ratio 0.3 --sample-thickness 2um --spring-constant 0.3N/m "$curve"
helps indent --tip sphere:radius=5um --poisson-ratio 0.3 --sample-thickness 2um --unbonded --spring-constant 0.3N/m "$curve" -o a.h5

piece 'a table of choices, as weartrack view writes it'
piece 'a table of choices, as weartrack view writes it'
cause 'as weartrack view writes it' indent --tip "$tip" --overrides empty.txt --spring-constant 0.3N/m "$curve"
helps view --help

piece 'a force without a spring constant: give --spring-constant 0.1N/m'
cause '--spring-constant 0.1N/m' sensitivity "$fixtures/formats/table-force/turning.txt"
leads sensitivity --spring-constant 0.1N/m "$fixtures/formats/table-force/turning.txt"

piece '`weartrack info FILE` shows what a file holds' '`weartrack info FILE` shows them'
cause '`weartrack info FILE`' master "$curve" -o a.h5
helps info "$curve"
cause '`weartrack info FILE` shows them' psd --image none "$road"
helps info "$road"
not_advice '`weartrack formats list` shows the formats' 'the library only: the program has looked before'

piece '--sensitivity %.6gnm/V' '--sensitivity-error %.2g' 'for weartrack indent: %s' 'for weartrack compare: %s'
"$weartrack" sensitivity -q --max-slope-change 5 --direction retract "$curve" -o slope.h5 2> err || :
given=$("$weartrack" table slope.h5 sensitivity --keys 2> err | sed -n 's/.*\(--sensitivity [^ ]*nm\/V\).*/\1/p' | head -n 1)
cause '' sensitivity "$curve"
[ -n "$given" ] || fail "sensitivity gives no option"
advice='no such text'
helps indent --tip "$tip" --spring-constant 0.3N/m $given "$curve" -o a.h5

piece 'give --indentation-temperature, and --track-temperature if the track differs'
"$weartrack" indent -q --group track --indentation-temperature 40degC --tip "$tip" --spring-constant 0.3N/m "$track" -o warm.h5 2> err
cause 'only the curves of the track state' compare bulk.h5 warm.h5
helps compare --indentation-temperature 23degC --track-temperature 40degC bulk.h5 warm.h5

piece 'indent with --misfit-p-threshold 0.01'
pair() {
  "$weartrack" indent -q --misfit-p-threshold "$1" --tip "$tip" "$curve" -o one.h5 2> err
  "$weartrack" indent -q --misfit-p-threshold "$1" --group track --tip "$tip" \
    "$fixtures/case/bulk-2.jpk-force-map" "$fixtures/case/bulk-3.jpk-force-map" -o other.h5 2> err
}
pair 0
cause 'indent with --misfit-p-threshold 0.01' compare --verbose --spot-scatter 0.1 --equivalence-margin 5 one.h5 other.h5
pair 0.01
helps compare --verbose --spot-scatter 0.1 --equivalence-margin 5 one.h5 other.h5

piece 'leave out --thick-sample or --sample-thickness'
cause 'leave out --thick-sample' indent --tip sphere:radius=5um --thick-sample --sample-thickness 2um --spring-constant 0.3N/m "$curve"
helps indent --tip sphere:radius=5um --sample-thickness 2um --spring-constant 0.3N/m "$curve" -o thin.h5
