/* Computes the findings from the result values. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/finding.h"
#include "core/base/text.h"
#include "core/table/result_rows_parts.h"

#include <ctype.h>
#include <math.h>

static finding_verdict difference_verdict(const result_value_tables *t, const result_value *f)
{
    if (t->comparison.table == NULL)
        return FINDING_NOT_COMPUTED;
    if (isnan(f->low) || isnan(f->high)) /* with one spot each there is no ratio either */
        return FINDING_NOT_ENOUGH_DATA;
    switch (comparison_key_enum(&t->comparison, COMPARISON_KEY_DIFFERS)) {
    case VERDICT_YES:
        return result_value_sign(f) != SIGN_UNDECIDED ? FINDING_YES : FINDING_INCONCLUSIVE;
    case VERDICT_NO:
        return FINDING_SAME;
    default:
        return FINDING_INCONCLUSIVE;
    }
}

static finding_verdict change_verdict(const result_value *f)
{
    if (isnan(f->number.value))
        return FINDING_NOT_COMPUTED;
    if (isnan(f->low) || isnan(f->high))
        return FINDING_NOT_ENOUGH_DATA;
    return result_value_sign(f) != SIGN_UNDECIDED ? FINDING_YES : FINDING_INCONCLUSIVE;
}

/* True if the critical energy is calibrated to a stated thickness, which is then not predicted. */
static bool is_thickness_given(const result_value_tables *t)
{
    return t->layer.table != NULL &&
           layer_key_enum(&t->layer, LAYER_KEY_CRITICAL_ENERGY_FROM) == ENERGY_CALIBRATED;
}

/* Returns a sentence that explains a verdict by the kind of its question alone. */
static const char *general_sentence(const finding *f)
{
    static const char *const undecided[FINDING_VERDICT_UNKNOWN] = {
        [FINDING_YES] = "",
        [FINDING_SAME] = "The moduli of track and bulk are equal within the margin of the test.",
        [FINDING_PREDICTED] = "At this thickness the layer forms as fast as it wears.",
        [FINDING_INCONCLUSIVE] = "The 95 % interval includes no difference.",
        [FINDING_NOT_ENOUGH_DATA] = "The data do not allow a 95 % interval.",
        [FINDING_NOT_COMPUTED] = ""};
    static const char *const missing[FINDING_QUESTIONS] = {
        [FINDING_TRACK_DIFFERS] = "This result does not compare moduli. Give force curves of bulk "
                                  "and track to weartrack compare or to a case.",
        [FINDING_LAYER_THICKNESS] = "This result has no layer. Give the wear rate and the critical "
                                    "energy to weartrack layer or to a case.",
        [FINDING_FRICTION_CHANGE] = "This result has no friction with a layer. Give a shear stress "
                                    "and a layer to weartrack friction or to a case."};
    static const char *const decided[FINDING_QUESTIONS][2] = {
        [FINDING_TRACK_DIFFERS] = {"The wear track is softer than the bulk.",
                                   "The wear track is stiffer than the bulk."},
        [FINDING_LAYER_THICKNESS] = {"", ""},
        [FINDING_FRICTION_CHANGE] = {"The layer lowers the friction.",
                                     "The layer raises the friction."}};
    const double value = f->value.number.value;
    if (f->question == FINDING_LAYER_THICKNESS && value == 0)
        return "There is no layer: wear removes the rubber faster than it is modified.";
    if (f->question == FINDING_LAYER_THICKNESS && isinf(value))
        return "The layer has no steady state: it grows without limit.";
    if (f->verdict == FINDING_NOT_COMPUTED && f->basis != FINDING_GIVEN)
        return missing[f->question];
    if (f->question == FINDING_FRICTION_CHANGE && f->verdict == FINDING_PREDICTED)
        return "There is no layer that could change the friction.";
    if (f->basis == FINDING_GIVEN)
        return "The critical energy is calibrated to the stated thickness.";
    const double neutral = f->value.neutral;
    if (f->verdict == FINDING_INCONCLUSIVE && (f->value.low > neutral || f->value.high < neutral))
        return "The 95 % interval shows a difference, but other choices of the model do not.";
    if (f->verdict != FINDING_YES)
        return undecided[f->verdict];
    return decided[f->question][f->sign == SIGN_ABOVE];
}

/* The test of the moduli states its own reason: "inconclusive: too few spots". */
static void write_sentence(finding *f)
{
    const char *const stated = f->value.verdict.reason;
    if (stated[0] == '\0' || f->question != FINDING_TRACK_DIFFERS)
        snprintf(f->sentence, sizeof f->sentence, "%s", general_sentence(f));
    else
        snprintf(f->sentence, sizeof f->sentence, "%c%s.", toupper((unsigned char)stated[0]),
                 stated + 1);
}

/* What to measure for the widest choice, how much of the range over model choices would remain,
 * and for a thickness the indentations that would tell it. */
static void write_remedy(const result_value_tables *t, finding *f)
{
    const result_value *v = &f->value;
    const result_value_range *r = &v->range;
    const char *const stated = v->remedy != NULL ? v->remedy : r->remedy;
    const char *const unit = v->neutral == 0 ? "%" : v->number.unit;
    f->rest = (r->rest_high - r->rest_low) / (r->high - r->low);
    snprintf(f->remedy, sizeof f->remedy, "%s", stated != NULL ? stated : "");
    if (stated == NULL || v->remedy != NULL || !isfinite(f->rest))
        return;
    clocale_append(f->remedy, sizeof f->remedy, " If confirmed, %s to %s remain.",
                   rows_short(r->rest_low, unit).value, rows_short(r->rest_high, unit).value);
    const char *const curves =
        f->question == FINDING_LAYER_THICKNESS && t->track_layer.table != NULL
            ? track_layer_key_text(&t->track_layer, TRACK_LAYER_KEY_SETTLED_BY)
            : NULL;
    if (curves != NULL && curves[0] != '\0')
        clocale_append(f->remedy, sizeof f->remedy, " By indentation: %s.", curves);
}

bool findings_compute(const result_value_tables *t, finding findings[FINDING_QUESTIONS])
{
    finding *differs = &findings[FINDING_TRACK_DIFFERS],
            *thickness = &findings[FINDING_LAYER_THICKNESS],
            *change = &findings[FINDING_FRICTION_CHANGE];
    *differs = (finding){.question = FINDING_TRACK_DIFFERS,
                         .basis = FINDING_MEASURED,
                         .value = result_value_ratio(t)};
    differs->verdict = difference_verdict(t, &differs->value);
    const bool assumed = t->comparison.table != NULL && differs->verdict != FINDING_YES;
    *thickness = (finding){.question = FINDING_LAYER_THICKNESS,
                           .basis = FINDING_FROM_THEORY,
                           .as_if_layer = assumed,
                           .value = result_value_thickness(t)};
    thickness->verdict =
        isnan(thickness->value.number.value) ? FINDING_NOT_COMPUTED : FINDING_PREDICTED;
    if (is_thickness_given(t)) {
        thickness->verdict = FINDING_NOT_COMPUTED;
        thickness->basis = FINDING_GIVEN;
    }
    *change = (finding){.question = FINDING_FRICTION_CHANGE,
                        .basis = FINDING_FROM_THEORY,
                        .as_if_layer = assumed,
                        .value = result_value_friction(t, FRICTION_KEY_RELATIVE_CHANGE)};
    change->verdict = change_verdict(&change->value);
    /* a change of exactly nothing needs no interval */
    if (change->verdict == FINDING_NOT_ENOUGH_DATA && thickness->value.number.value == 0)
        change->verdict = FINDING_PREDICTED;
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict == FINDING_YES)
            findings[i].sign = result_value_sign(&findings[i].value);
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        write_sentence(&findings[i]);
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        write_remedy(t, &findings[i]);
    return t->comparison.table != NULL || t->layer.table != NULL;
}

const char *finding_question_text(finding_question question)
{
    static const char *const text[FINDING_QUESTIONS] = {
        [FINDING_TRACK_DIFFERS] = "Is the track different?",
        [FINDING_LAYER_THICKNESS] = "How thick is the layer?",
        [FINDING_FRICTION_CHANGE] = "What does it do to friction?"};
    return text[question];
}

const char *finding_subject_text(finding_question question)
{
    static const char *const text[FINDING_QUESTIONS] = {
        [FINDING_TRACK_DIFFERS] = "Modulus ratio",
        [FINDING_LAYER_THICKNESS] = "Layer thickness",
        [FINDING_FRICTION_CHANGE] = "Change of friction"};
    return text[question];
}

const char *finding_side_text(const finding *f)
{
    static const char *const text[FINDING_QUESTIONS][2] = {
        [FINDING_TRACK_DIFFERS] = {", softer", ", stiffer"},
        [FINDING_LAYER_THICKNESS] = {"", ""},
        [FINDING_FRICTION_CHANGE] = {", lower", ", higher"}};
    return f->sign == SIGN_UNDECIDED ? "" : text[f->question][f->sign == SIGN_ABOVE];
}

bool findings_are_stated(const table_view *answer)
{
    return answer->n_rows == FINDING_QUESTIONS && answer_has(answer, ANSWER_VERDICT);
}
