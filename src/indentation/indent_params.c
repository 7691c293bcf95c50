/* The parameters of the indentation job. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "indentation/curve_selection.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Smallest Poisson's ratio for the law of a bonded layer. The law holds for 0.5, because a
 * compressible layer yields under the tip. */
static const double least_bonded_poisson = 0.499;

wt_indent_job wt_indent_job_defaults(void)
{
    return (wt_indent_job){
        .group = "bulk",
        .options = wt_indent_defaults(),
        .spring_constant = {(double)NAN, 0, 0, "N/m"},
        .sensitivity = {(double)NAN, 0, 0, "m/V"},
        .temperature = {(double)NAN, (double)NAN, 0, "K"},
        .rates = true,
    };
}

wt_status indent_read_tip(const char *text, void *tip, wt_error *err)
{
    wt_tip parsed, *to = tip;
    const wt_status status = wt_tip_parse(text, &parsed, err);
    if (status != WT_OK)
        return status;
    parsed.sample_thickness = to->sample_thickness; /* parameters of their own */
    parsed.unbonded = to->unbonded;
    *to = parsed;
    return WT_OK;
}

wt_status indent_check_tip(const void *tip, wt_error *err)
{
    return wt_tip_check(tip, err);
}

static wt_status check_group_name(const void *member, wt_error *err)
{
    const char *group = *(const char *const *)member;
    if (*group != '\0' && group[strspn(group, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0')
        return WT_OK;
    return wt_fail(err, WT_E_ARG, "'%s' is not made of a-z, 0-9 and _", group);
}

static wt_status check_curve_selection(const void *member, wt_error *err)
{
    const char *at = member;
    const wt_indent_job *job = (const void *)(at - offsetof(wt_indent_job, curves));
    curve_selection selection;
    const wt_status status = curve_selection_begin(job, &selection, err);
    curve_selection_clear(&selection);
    return status;
}

wt_status indent_error_check(const void *estimate, wt_error *err)
{
    const wt_estimate *e = estimate;
    if (isnan(e->value) || e->standard_error < e->value)
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_RANGE, "the standard error must be smaller than the value");
    wt_error_expected(err, "an error below %g %s", e->value, e->unit);
    wt_error_found(err, "%g %s", e->standard_error, e->unit);
    wt_error_advice(err, "give the error behind +-, in %% or with its unit, or leave it out");
    return status;
}

static const wt_param rows[] = {
    {PARAM_OTHER_OF("tip", wt_indent_job, tip, indent_read_tip), .check = indent_check_tip,
     .value = "TIP", .flags = PARAM_REQUIRED,
     .help = "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=16nm] (axis to FACE), "
             "berkovich:radius=150nm, vickers:radius=200nm, "
             "cone:half-angle=20deg[,radius=20nm], sphere:radius=5um, paraboloid:radius=5um or "
             "punch:radius=2um; half-angle and radius with their standard errors, as "
             "radius=20nm+-15%"},
    {PARAM("sample-thickness", wt_indent_job, tip.sample_thickness, WT_Q_LENGTH, AT_LEAST(0)),
     .value = "H",
     .help = SUCH_AS("of a thin sample on a rigid base, ", "2um",
                     "; 0 is thick; with its standard error, as 2um+-5%")},
    {PARAM_FLAG_OF("unbonded", wt_indent_job, tip.unbonded),
     .help = "the thin sample slides on its base"},
    {PARAM_FLAG_OF("thick-sample", wt_indent_job, thick_sample),
     .help = "the sample is so thick (100 contact radii) that no base has an effect"},
    {PARAM_TEXT_OF("group", wt_indent_job, group), .check = check_group_name, .value = "NAME",
     .flags = PARAM_NO_CASE, .help = "what these curves are: bulk, track or another name"},
    {PARAM("indentation-temperature", wt_indent_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "the reference temperature of the DMA", .flags = PARAM_NO_CASE,
     .help = "at which the sample was indented; for the spectrum of the DMA and for compare"},
    SPRING_CONSTANT(wt_indent_job, PARAM_NO_CASE, indent_error_check),
    SENSITIVITY(wt_indent_job, PARAM_NO_CASE, indent_error_check),
    {PARAM("spring-constant-error", wt_indent_job, lever_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X", .flags = PARAM_NO_CASE,
     .help = SUCH_AS("relative standard error of a spring constant that states none, ", "0.1", "")},
    {PARAM("sensitivity-error", wt_indent_job, sensitivity_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X", .flags = PARAM_NO_CASE,
     .help = SUCH_AS("relative standard error of a deflection sensitivity that states none, ",
                     "0.05", "")},
    {PARAM("piezo-nonlinearity", wt_indent_job, piezo_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X",
     .help = SUCH_AS("standard error of the height by a bend of the piezo over the approach, of "
                     "its travel, ",
                     "0.001", "")},
    {PARAM("detector-nonlinearity", wt_indent_job, detector_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X",
     .help = SUCH_AS("standard error of the largest force by a detector that is not linear, of "
                     "the force, ",
                     "0.002", "")},
    {PARAM_TEXTS_OF("curves", wt_indent_job, curves, n_curves), .check = check_curve_selection,
     .value = "WHICH", .unset = "",
     .help = "curves to look at, as the table curves: rejected, worst:N (of the largest relative "
             "error of the modulus), all or FILE:N; median is the representative one, whole, as "
             "force_displacement and force_indentation"},
    {PARAM_TEXT_OF("overrides", wt_indent_job, choices), .former = "choices", .value = "FILE",
     .unset = "", .flags = PARAM_NO_CASE | PARAM_READ,
     .help = "what was chosen by hand: curves left out, contact points of curves, spring constant, "
             "sensitivity and tip of files"},
};
PARAM_TABLE(wt_indent_job_params, wt_indent_job, rows, wt_indent_job_defaults,
            PARAM_PART(wt_indent_params, wt_indent_job, options))

/* ---- combinations of parameters -------------------------------------------------------------- */

bool indent_is_incompressible(const wt_indent_options *options)
{
    return options->poisson_ratio >= least_bonded_poisson;
}

static wt_status check_sample(const wt_indent_job *job, wt_error *err)
{
    if (job->tip.sample_thickness.value > 0.0 && job->thick_sample) {
        const wt_status twice = wt_fail(err, WT_E_ARG, "the sample is stated as thick and as thin");
        wt_error_expected(err, "one of the two");
        return twice;
    }
    if (!(job->tip.sample_thickness.value > 0.0) || job->tip.unbonded ||
        indent_is_incompressible(&job->options))
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_RANGE, "a thin sample bonded to its base is known for rubber only");
    wt_error_expected(err, "Poisson's ratio of %g or more, or --unbonded", least_bonded_poisson);
    wt_error_found(err, "poisson-ratio %g", job->options.poisson_ratio);
    return status;
}

wt_status indent_job_check(const wt_indent_job *job, wt_error *err)
{
    wt_status status = param_check(wt_indent_job_params(), job, err);
    if (status == WT_OK)
        status = check_sample(job, err);
    return status == WT_OK ? curve_range_check(&job->options, &job->tip, err) : status;
}

static size_t append_range_text(char *text, size_t size, size_t length, const char *addition)
{
    if (length + strlen(addition) >= size)
        return length;
    strcpy(text + length, addition);
    return length + strlen(addition);
}

bool indent_range_text(const wt_indent_options *o, char *text, size_t size)
{
    const struct {
        const char *quantity, *unit;
        double from, to;
        const char *of;
    } ranges[] = {
        {"indentation", "m", o->fit_depth_from, o->fit_depth, ""},
        {"indentation", "", 0, o->fit_radii, " radii"},
        {"force", "N", o->fit_force_from, o->fit_force, ""},
        {"force", "", o->fit_force_fraction_from,
         o->fit_force_fraction < 1 ? o->fit_force_fraction : 0, " of the largest"},
    };
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        char number[32];
        if (!(ranges[i].from > 0) && !(ranges[i].to > 0))
            continue;
        length = append_range_text(text, size, length, length > 0 ? ", " : "");
        length = append_range_text(text, size, length, ranges[i].quantity);
        for (int end = 0; end < 2; end++) {
            const double value = end == 0 ? ranges[i].from : ranges[i].to;
            if (!(value > 0))
                continue;
            if (ranges[i].unit[0] != '\0')
                wt_format_si(value, ranges[i].unit, 4, number, sizeof number);
            else
                wt_number_format(value, number);
            length = append_range_text(text, size, length, end == 0 ? " from " : " to ");
            length = append_range_text(text, size, length, number);
        }
        length = append_range_text(text, size, length, ranges[i].of);
    }
    return length > 0;
}

/* Dimensions of a tip that have a key each. A key is absent where the dimension is 0. */
static const struct {
    indentation_key key;
    size_t offset; /* of a double in wt_tip */
} tip_keys[] = {
    {INDENTATION_KEY_TIP_HALF_ANGLE, offsetof(wt_tip, half_angle)},
    {INDENTATION_KEY_TIP_RADIUS, offsetof(wt_tip, radius)},
    {INDENTATION_KEY_TIP_TRANSITION, offsetof(wt_tip, transition_radius)},
    {INDENTATION_KEY_SAMPLE_THICKNESS, offsetof(wt_tip, sample_thickness)},
};

void indent_set_tip_keys(const wt_tip *tip, table_writer *to)
{
    indentation_set_text(to, INDENTATION_KEY_TIP_SHAPE, tip_shape_text((tip_shape)tip->shape));
    if (tip->sides > 0)
        indentation_set_value(to, INDENTATION_KEY_TIP_SIDES, tip->sides, 0, 0);
    for (size_t i = 0; i < COUNT_OF(tip_keys); i++) {
        const double value = *(const double *)((const char *)tip + tip_keys[i].offset);
        if (value > 0)
            indentation_set_value(to, tip_keys[i].key, value, (double)NAN, 0);
    }
}

bool indent_tip_from_table(const table_view *t, wt_tip *tip)
{
    const double most_sides = tip_dimensions[TIP_SIDES].limits.high,
                 sides = fmax(0, indentation_value(t, INDENTATION_KEY_TIP_SIDES).value);
    const int shape = indentation_key_enum(t, INDENTATION_KEY_TIP_SHAPE);
    if (shape < 0 || shape >= TIP_SHAPE_UNKNOWN || !(sides <= most_sides))
        return false;
    *tip = (wt_tip){.shape = (wt_tip_shape)shape, .sides = (unsigned)sides};
    for (size_t i = 0; i < COUNT_OF(tip_keys); i++) /* a missing key is NaN */
        *(double *)((char *)tip + tip_keys[i].offset) =
            fmax(0, indentation_value(t, tip_keys[i].key).value);
    return wt_tip_check(tip, NULL) == WT_OK;
}

wt_status indent_contact_table(const wt_tip *tip, wt_contact_table **table, wt_error *err)
{
    return wt_contact_table_new(tip, 1e-11, 1e-4, table, err);
}
