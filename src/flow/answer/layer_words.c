/* What the answer says of a layer beyond its thickness at constant load.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/story.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static const char how_thick[] = "How thick is it?",
                  what_friction[] = "What does it do to friction?";

/* The thinnest that a layer stays at; NaN: none. */
static double thinnest_stable(const table_view *v)
{
    double least = (double)NAN;
    for (size_t i = 0; i < v->n_rows; i++)
        if (strcmp(layer_balances_text(v, i, LAYER_BALANCES_STABLE), "stable") == 0)
            least = fmin(least, layer_balances_get(v, i, LAYER_BALANCES_THICKNESS));
    return least;
}

static void say_balances(const answer_story *story)
{
    const table_view *const v = &story->layer_balances;
    const double least = v->table != NULL ? thinnest_stable(v) : (double)NAN;
    if (v->table == NULL)
        return;
    answer_say(story, how_thick, "thickness",
               "Where the layer acts back on the energy that makes it, from a bare surface %s%s: "
               "%s.",
               isnan(least) ? "no balance is found"
               : least > 0  ? "the balance is at "
                            : "there is no layer",
               least > 0 ? words_of(least, "m").text : "",
               layer_balances_words(v, LAYER_BALANCES_KEY_WORDS));
}

static void say_existence(const answer_story *story)
{
    const table_view *const v = &story->existence;
    if (v->table != NULL)
        answer_say(story, how_thick, "thickness", "At %s a layer exists %s.",
                   words_of(existence_value(v, EXISTENCE_KEY_PRESSURE).value, "Pa").text,
                   existence_words(v, EXISTENCE_KEY_WORDS));
}

void answer_track_layer(const answer_story *story)
{
    const table_view *const v = &story->track_layer;
    if (v->table == NULL)
        return;
    const char *const allowed = track_layer_words(v, TRACK_LAYER_KEY_ALLOWED),
                      *const agree = track_layer_words(v, TRACK_LAYER_KEY_AGREE),
                      *const settled_by = track_layer_words(v, TRACK_LAYER_KEY_SETTLED_BY);
    answer_say(story, how_thick, "thickness",
               "What thickness do the curves alone allow? %c%s.%s%s%s%s%s%s",
               toupper((unsigned char)allowed[0]), allowed + 1,
               agree != NULL ? " Does the theory agree? " : "", agree != NULL ? agree : "",
               agree != NULL ? "." : "", settled_by != NULL ? " What would settle it: " : "",
               settled_by != NULL ? settled_by : "", settled_by != NULL ? "." : "");
}

static void say_bands(const answer_story *story)
{
    const table_view *const v = &story->layer_bands;
    const char *const events =
        v->table != NULL ? layer_bands_words(v, LAYER_BANDS_KEY_EVENTS) : NULL;
    if (events != NULL)
        answer_say(story, how_thick, "thickness", "By the transport of damage: %s.", events);
}

void answer_layer_models(const answer_story *story)
{
    say_bands(story);
    say_balances(story);
    say_existence(story);
}

void answer_running_in(const answer_story *story)
{
    const table_view *const v = &story->running_in;
    if (v->table == NULL)
        return;
    const double bare = running_in_value(v, RUNNING_IN_KEY_BARE).value,
                 end = running_in_value(v, RUNNING_IN_KEY_BALANCE).value,
                 settled = running_in_value(v, RUNNING_IN_KEY_SETTLED).value;
    char text[96] = "";
    telling t = {text, sizeof text, 0};
    if (!isnan(settled))
        tell(&t, "; 5 %% of the change are left after %s in contact", words_of(settled, "s").text);
    if (!isnan(end))
        answer_say(story, what_friction, "friction",
                   "While the layer grows, friction goes from %.3g to %.3g%s.", bare, end, text);
}
