/* weartrack indent: contact point and modulus of every force curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "cmd/readopts.h"

static bool is_group_name(const char *text)
{
    return *text != '\0' && strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_") == strlen(text);
}

int cmd_indent(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_read_values values;
    cmd_read_values_init(&values);
    wt_indent_job job = wt_indent_job_defaults();
    wt_file_set set = {0};
    const char *group = "bulk", *tip = NULL;
    bool no_tilt = false, curves = false;
    cmd_option options[24] = {
        {"tip", 0, CMD_TEXT, &tip, "TIP", WT_Q_NONE,
         "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=16nm] (axis to FACE), "
         "sphere:radius=5um or cone:half-angle=20deg; required"},
        {"group", 0, CMD_TEXT, &group, "NAME", WT_Q_NONE,
         "what these curves are: bulk (default), track, or another name"},
        {"spot", 0, CMD_TEXT, &set.spot, "NAME", WT_Q_NONE,
         "all curves come from this place on the sample; default: each file is a spot"},
        {"poisson-ratio", 0, CMD_NUMBER, &job.options.poisson_ratio, "NU", WT_Q_NONE,
         "of the rubber; default 0.5"},
        {"fit-depth", 0, CMD_QUANTITY, &job.options.fit_depth, "D", WT_Q_LENGTH,
         "fit indentations up to this depth, such as 50nm; default: all"},
        {"fit-force-fraction", 0, CMD_NUMBER, &job.options.fit_force_fraction, "X", WT_Q_NONE,
         "fit forces up to this share of the largest; default 1"},
        {"fixed-contact-point", 0, CMD_QUANTITY, &job.options.fixed_contact_point, "Z", WT_Q_LENGTH,
         "do not fit the contact point: take this tip position"},
        {"minimum-r-squared", 0, CMD_NUMBER, &job.options.minimum_r_squared, "X", WT_Q_NONE,
         "reject a curve whose contact part is described worse than this"},
        {"no-tilt", 0, CMD_FLAG, &no_tilt, NULL, WT_Q_NONE,
         "baseline with an offset only, no tilt"},
        {"curves", 0, CMD_FLAG, &curves, NULL, WT_Q_NONE,
         "also write the representative (median) curve and its fit"}};
    size_t n = 10;
    n += cmd_read_force_options(&values, options + n);
    n += cmd_read_units_option(&values, options + n);
    const cmd_usage usage = {
        "indent", "--tip TIP [OPTION]... FILE...",
        "Fits baseline, contact point and modulus of every approach curve of the files (folders "
        "and\n"
        "patterns are allowed). One row per curve; a curve without a modulus says why.",
        CMD_OPT_OUTPUT | CMD_OPT_FORMAT | CMD_OPT_FORMATS | CMD_OPT_THREADS | CMD_OPT_PROVENANCE,
        "Exit status 1 if a file could not be read; the others are answered all the same."};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    cmd_session s = {0};
    wt_indent_tables tables = {0};
    wt_table *groups = NULL;

    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    if (tip == NULL) {
        status = cmd_usage_error("indent", "--tip is missing: no modulus without the tip's shape");
        goto done;
    }
    if (!is_group_name(group)) {
        status = cmd_usage_error("indent", "--group '%s' is not made of a-z, 0-9 and _", group);
        goto done;
    }
    if (first == argc) {
        status = cmd_usage_error("indent", "no file given");
        goto done;
    }
    if (wt_tip_parse(tip, &job.tip, &err) != WT_OK) {
        char line[1024];
        wt_error_format(&err, line, sizeof line);
        status = cmd_usage_error("indent", "--tip: %s", line);
        goto done;
    }
    set.patterns = (const char *const *)(argv + first);
    set.n_patterns = (size_t)(argc - first);
    set.read = cmd_read_make(&values, &common);
    job.group = group;
    job.sets = &set;
    job.n_sets = 1;
    job.options.fit_tilt = !no_tilt;
    job.rates = true;
    job.curves = curves;
    status = cmd_begin(&s, "indent", &common);
    if (status != CMD_OK)
        goto done;
    wt_status made = wt_indent_group(&job, &s.work, &tables, &err);
    const wt_table *const indentation[] = {tables.indentation};
    if (made == WT_OK)
        made = wt_modulus_groups(indentation, 1, &groups, &err);
    wt_table *failures = wt_table_n_rows(s.work.failures) > 0 ? s.work.failures : NULL;
    wt_table **const parts[] = {&tables.indentation, &groups, &tables.force_displacement,
                                &tables.force_indentation, &failures};
    status = cmd_finish(&s, made, parts, sizeof parts / sizeof parts[0], &err);
done:
    wt_table_free(groups);
    wt_indent_tables_clear(&tables);
    cmd_session_free(&s);
    cmd_read_values_free(&values);
    return status;
}
