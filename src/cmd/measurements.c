/* weartrack indent, spot, sensitivity, psd and record: force curves, surfaces and friction records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

/* ---- indent ---------------------------------------------------------------------------------- */

typedef struct indent_dma_options {
    const char *master;
} indent_dma_options;

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", indent_dma_options, master), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "output of weartrack master: a factor on its relaxation spectrum is fitted, so that "
             "curves of all rates are comparable"},
};
CMD_OPTIONS(indent_dma_params, indent_dma_options, rows)

/* That no curve has a modulus is an answer, unless no curve could be read. As a loss it is in the
 * file, so that summary has the same status. */
static void report_no_modulus(cmd_session *s, const wt_table *indentation)
{
    wt_log_add(s->log, WT_LOSS, NULL, NULL,
               "no curve has a modulus; the columns verdict and reason of the table indentation "
               "state the cause");
    cmd_set_partial(s);
    s->next = NULL;
    if (wt_table_n_rows(s->work.failures) >= wt_table_n_rows(indentation))
        s->status = CMD_FAILED;
}

int cmd_indent(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "indent",
        .next = "compare BULK TRACK, the results of indent for both",
        .arguments = "--tip TIP [OPTION]... FILE...",
        .description =
            "Fits baseline, contact point and modulus of every approach curve of the files "
            "(folders and patterns are allowed). One row per curve; a curve without a modulus "
            "says why.",
        .common = "output formats columns files-from provenance cost",
        .first = "tip spring-constant sensitivity spring-constant-error poisson-ratio fit-depth "
                 "fit-force sample-thickness master group curves output",
        .notes =
            "Exit status 3 if a file or curve could not be read and others are answered, and if no "
            "curve has a modulus: the table says why; 1 if no curve could be read.",
        .n_files = CMD_ONE_OR_MORE};
    wt_indent_job job = wt_indent_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_session s = cmd_session_defaults();
    indent_dma_options own = {0};
    wt_read_options dma_read = wt_read_defaults();
    enum { PART_DMA = 4 };
    wt_rubber rubber = {0};
    wt_result *dma = NULL;
    cmd_option_group parts[] = {
        {indent_dma_params(), &own, NULL, 0},
        {wt_indent_job_params(), &job, NULL, 0},
        {wt_file_set_params(), &set, "spot units format sheet conditioning", 0},
        {wt_job_params(), &s.work, "threads", 0},
        [PART_DMA] = {wt_read_params(), &dma_read, "sample", 0}};
    wt_indent_tables tables = {0};
    wt_table *groups = NULL, *budget = NULL;
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin_files(&s, &set) ||
        (job.thick_sample && job.tip.sample_thickness.value > 0 &&
         !cmd_usage_error(&s, "the sample is stated as thick and as thin; leave out --thick-sample "
                              "or --sample-thickness")) ||
        (own.master == NULL && parts[PART_DMA].given != 0 &&
         !cmd_usage_error(&s, "--sample goes with --master")))
        return cmd_session_free(&s);
    job.sets = &set;
    job.n_sets = 1;
    wt_status status = WT_OK;
    if (own.master != NULL) {
        wt_cost_begin_stage(s.cost, "given_material");
        status = cmd_rubber_read(own.master, dma_read.sample, job.options.poisson_ratio, &s.work,
                                 &dma, &rubber, &s.err);
        if (status == WT_OK)
            wt_rubber_add_cost(&rubber, &s.work);
        job.rubber = &rubber;
    }
    char stage[64];
    snprintf(stage, sizeof stage, "indentation_%s", job.group);
    wt_cost_begin_stage(s.cost, stage);
    if (status == WT_OK)
        status = wt_indent_group(&job, &s.work, &tables, &s.err);
    const wt_table *const indentation[] = {tables.indentation};
    if (status == WT_OK)
        status = wt_modulus_groups_table(indentation, 1, &groups, &s.err);
    if (status == WT_OK)
        status = wt_modulus_budget_table(indentation, 1, &budget, &s.err);
    if (status == WT_OK && tables.n_accepted == 0)
        report_no_modulus(&s, tables.indentation);
    wt_table **const made_tables[] = {&tables.indentation,
                                      &groups,
                                      &budget,
                                      &tables.choices,
                                      &tables.modulus_depth,
                                      &tables.force_displacement,
                                      &tables.force_indentation,
                                      &tables.curves};
    cmd_finish(&s, status, made_tables, COUNT_OF(made_tables));
    wt_rubber_clear(&rubber);
    wt_result_free(dma);
    return cmd_session_free(&s);
}

/* ---- spot ------------------------------------------------------------------------------------ */

int cmd_spot(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "spot",
        .arguments = "--tip TIP --depth D [OPTION]... IMAGE",
        .description =
            "Computes the roughness of a spot over the contact from a height image taken before an "
            "indentation, and reports whether the spot is too rough for that depth.",
        .common = "output formats columns provenance cost",
        .n_files = 1};
    wt_indent_job indent = wt_indent_job_defaults();
    wt_spot_job job = wt_spot_job_defaults();
    cmd_option_group parts[] = {
        {wt_indent_job_params(), &indent, "tip", 0},
        {wt_spot_job_params(), &job, NULL, 0},
        {wt_read_params(), &job.read, "units pixel-size height-unit format sheet", 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL, **const tables[] = {&made};
    if (cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) &&
        cmd_begin_reading(&s, job.read.format)) {
        job.tip = indent.tip;
        wt_cost_begin_stage(s.cost, "spot");
        const wt_status status = wt_spot_compute(&job, s.files[0], &s.work, &made, &s.err);
        cmd_finish(&s, status, tables, COUNT_OF(tables));
    }
    return cmd_session_free(&s);
}

/* ---- sensitivity ----------------------------------------------------------------------------- */

int cmd_sensitivity(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "sensitivity",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Deflection sensitivity (inverse optical lever sensitivity, nm/V) of force curves "
            "on a hard surface: slope in contact of each curve, approach and retract, their "
            "scatter, and whether the surface is hard and the detector straight. Of curves "
            "whose deflection is in metres, the factor that corrects them. Folders and "
            "patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables sensitivity and sensitivity_curves follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_sensitivity_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "spring-constant units format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_sensitivity_tables made = {0};
    wt_table **const tables[] = {&made.sensitivity, &made.sensitivity_curves};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_sensitivity_compute(&job, &s.work, &made, &s.err), tables,
                   COUNT_OF(tables));
    return cmd_session_free(&s);
}

/* ---- psd ------------------------------------------------------------------------------------- */

int cmd_psd(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "psd",
        .next = "friction --roughness@ --material DMA",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Power spectrum C(q) of a surface from height maps and profiles of it, as "
            "friction and layer take it: with errors, the reliable range, "
            "a self-affine law and the roughness numbers of every scan. Scans of several sizes "
            "are stitched, several places averaged. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables power_spectrum, place_errors (of scans of several sizes), "
                 "angular_spectrum (of height maps), surfaces, height_map (of height maps) and "
                 "height_profile "
                 "(both with --heights) follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_topography_job job = wt_topography_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_topography_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "units pixel-size height-unit format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_topography_tables made = {0};
    wt_table **const tables[] = {&made.power_spectrum, &made.place_errors, &made.angular_spectrum,
                                 &made.surfaces,       &made.height_map,   &made.height_profile};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_topography_compute(&job, &s.work, &made, &s.err), tables,
                   COUNT_OF(tables));
    return cmd_session_free(&s);
}

/* ---- record ---------------------------------------------------------------------------------- */

int cmd_record(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "record",
        .next = "validate CASE.xml@",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Records of pin-on-disc, linear and reciprocating tribometers: where the running-in "
            "ends, the friction coefficient behind it, and its drift, each with "
            "its error, at every velocity, load and temperature of the record; with the loss "
            "of the track the specific wear rate. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables record, record_cycles and (where something of the wear is given) wear "
                 "follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_record_job job = wt_record_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_record_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "units format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_record_tables made = {0};
    wt_table **const tables[] = {&made.record, &made.record_cycles, &made.wear};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv)) {
        if (job.profile != NULL)
            cmd_share_unit_options(&s, &set.read);
        cmd_finish(&s, wt_record_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    }
    return cmd_session_free(&s);
}
