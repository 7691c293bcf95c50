/* What is said of friction and wear as measured.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/story.h"
#include "flow/answer/words.h"

#include <math.h>

/* Of the rows in which something slides, or is not known to rest; *n counts them. */
static double extreme_friction(const table_view *v, double sign, size_t *n)
{
    double most = (double)NAN;
    *n = 0;
    for (size_t i = 0; i < v->n_rows; i++) {
        if (record_get(v, i, RECORD_VELOCITY) == 0 || record_get(v, i, RECORD_ROTATION) == 0)
            continue;
        most = sign * fmax(sign * most, sign * record_get(v, i, RECORD_FRICTION));
        ++*n;
    }
    return most;
}

void tell_record(telling *t, const table_view *v)
{
    const wt_estimate mu = record_value(v, RECORD_KEY_FRICTION);
    size_t n;
    const double least = extreme_friction(v, -1, &n), most = extreme_friction(v, 1, &n);
    if (n == 0)
        tell(t, "no friction of sliding: nothing slides");
    else if (isnan(mu.value))
        tell(t, "friction as measured at %zu conditions, from %.4g to %.4g", n, least, most);
    else
        tell(t, "friction as measured %s", words_of_estimate(mu).text);
    const double end = record_get(v, 0, RECORD_RUNNING_IN);
    if (v->n_rows == 1 && !isnan(end))
        tell(t, ", after a running-in of %.0f cycles", end);
    else if (v->n_rows == 1)
        tell(t, "; %s", record_text(v, 0, RECORD_RUNNING_IN_NOTE));
    if (v->n_rows == 1 && record_text(v, 0, RECORD_NOTE)[0] != '\0')
        tell(t, "; %s", record_text(v, 0, RECORD_NOTE));
}

void tell_wear(telling *t, const table_view *v)
{
    const wt_estimate k = wear_value(v, WEAR_KEY_RATE);
    if (isnan(k.value))
        tell(t, "no specific wear rate: %s", wear_text(v, 0, WEAR_NOTE));
    else
        tell(t, "specific wear rate %s", words_of_positive(k).text);
}

void answer_record(const answer_story *story)
{
    char text[900];
    telling t = {text, sizeof text, 0};
    if (story->record.n_rows == 0)
        return;
    tell_record(&t, &story->record);
    if (story->wear.n_rows > 0) {
        tell(&t, "; ");
        tell_wear(&t, &story->wear);
    }
    if (text[0] >= 'a' && text[0] <= 'z')
        text[0] = (char)(text[0] - 'a' + 'A');
    answer_say(story, "What was measured of friction?", "record", "%s.", text);
}
