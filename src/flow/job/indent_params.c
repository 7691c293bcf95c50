/* The parameters of the indentation job. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/param.h"
#include "weartrack/flow.h"

#include <math.h>
#include <string.h>

wt_indent_job wt_indent_job_defaults(void)
{
    return (wt_indent_job){
        .group = "bulk",
        .options = wt_indent_defaults(),
        .spring_constant = {(double)NAN, 0, 0, "N/m"},
        .temperature = {(double)NAN, (double)NAN, 0, "K"},
        .rates = true,
    };
}

static wt_status read_tip(const char *text, void *tip, wt_error *err)
{
    wt_tip made, *to = tip;
    const wt_status status = wt_tip_parse(text, &made, err);
    if (status != WT_OK)
        return status;
    made.sample_thickness = to->sample_thickness; /* parameters of their own */
    made.unbonded = to->unbonded;
    *to = made;
    return WT_OK;
}

static wt_status check_tip(const void *tip, wt_error *err)
{
    return wt_tip_check(tip, err);
}

static wt_status check_group(const void *member, wt_error *err)
{
    const char *group = *(const char *const *)member;
    if (*group != '\0' && group[strspn(group, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0')
        return WT_OK;
    return wt_fail(err, WT_E_ARG, "'%s' is not made of a-z, 0-9 and _", group);
}

static const wt_param rows[] = {
    {PARAM_OTHER_OF("tip", wt_indent_job, tip, read_tip), .check = check_tip, .value = "TIP",
     .flags = PARAM_REQUIRED,
     .help = "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=16nm] (axis to FACE), "
             "cone:half-angle=20deg[,radius=20nm], sphere:radius=5um, paraboloid:radius=5um or "
             "punch:radius=2um"},
    {PARAM("sample-thickness", wt_indent_job, tip.sample_thickness, WT_Q_LENGTH, AT_LEAST(0)),
     .value = "H", .help = "of a thin sample on a rigid base, such as 2um; 0 is thick"},
    {PARAM_FLAG_OF("unbonded", wt_indent_job, tip.unbonded),
     .help = "the thin sample slides on its base"},
    {PARAM_TEXT_OF("group", wt_indent_job, group), .check = check_group, .value = "NAME",
     .flags = PARAM_NO_CASE, .help = "what these curves are: bulk, track or another name"},
    {PARAM("indentation-temperature", wt_indent_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "the reference temperature of the DMA", .flags = PARAM_NO_CASE,
     .help = "at which the sample was indented; for the spectrum of the DMA"},
    {PARAM_FLAG_OF("curves", wt_indent_job, curves), .flags = PARAM_NO_CASE,
     .help = "also the representative (median) curve and its fit"},
};
PARAM_TABLE(wt_indent_job_params, wt_indent_job, rows, wt_indent_job_defaults,
            PARAM_PART(wt_indent_params, wt_indent_job, options))
