/* Options about rubber, counter surface and conditions. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include <math.h>
#include <string.h>

#include "cmd/sliding.h"
#include "cmd/tables.h"

void cmd_sliding_init(cmd_sliding *s)
{
    memset(s, 0, sizeof *s);
    cmd_read_values_init(&s->read);
    cmd_dma_init(&s->dma);
    s->conditions = wt_sliding_defaults();
    s->conditions.pressure.value = (double)NAN;
    s->work = wt_job_defaults();
    s->poisson_ratio = 0.5;
    s->replicates = s->work.replicates;
}

void cmd_sliding_free(cmd_sliding *s)
{
    cmd_list_free(&s->dma_files);
    cmd_values_free(&s->velocity);
    cmd_read_values_free(&s->read);
    wt_rubber_clear(&s->rubber);
    wt_surface_clear(&s->surface);
    wt_result_free(s->material_tables);
    wt_result_free(s->result);
    wt_parselog_free(s->log);
    wt_formats_free(s->formats);
}

size_t cmd_sliding_options(cmd_sliding *s, cmd_option *options)
{
    const cmd_option own[] = {
        {"material", 'm', CMD_TEXT, &s->material, "FILE", WT_Q_NONE,
         "output of weartrack master (text stream or .h5); - is standard input"},
        {"dma", 0, CMD_LIST, &s->dma_files, "FILE", WT_Q_NONE,
         "DMA file, folder or pattern instead of --material; repeatable. The standard errors "
         "then include those of the shift and of the series"},
        {"roughness", 0, CMD_TEXT, &s->roughness, "R", WT_Q_NONE,
         "self-affine:q0=..rad/m,qr=..rad/m,q1=..rad/m,hurst=..,c0=..m^4 or a spectrum file"},
        {"pressure", 'p', CMD_ESTIMATE, &s->conditions.pressure, "P", WT_Q_PRESSURE,
         "nominal pressure, such as 0.4MPa or \"0.4MPa+-5%\""},
        {"velocity", 'v', CMD_VALUES, &s->velocity, "V", WT_Q_VELOCITY,
         "0.3m/s, a list 1mm/s,1cm/s or a range 1e-4:10m/s:log:40"},
        {"sliding-temperature", 't', CMD_ESTIMATE, &s->conditions.temperature, "T",
         WT_Q_TEMPERATURE, "of the rubber while it slides; default: the material's reference"},
        {"shear-stress", 0, CMD_ESTIMATE, &s->conditions.shear_stress, "TAU", WT_Q_PRESSURE,
         "tau_f of the real contact, such as 5MPa; without it no total friction"},
        {"poisson-ratio", 0, CMD_NUMBER, &s->poisson_ratio, "NU", WT_Q_NONE,
         "of the rubber; default 0.5"},
        {"gamma", 0, CMD_NUMBER, &s->conditions.gamma, "G", WT_Q_NONE,
         "partial-contact factor S = G + (1-G)P^2; default 1, Persson 2001"},
        {"tolerance", 0, CMD_NUMBER, &s->work.tolerance, "X", WT_Q_NONE,
         "relative numerical error asked for; default 1e-10"},
        {"replicates", 0, CMD_COUNT, &s->replicates, "N", WT_Q_NONE,
         "refits behind the standard errors; default 64, 0 for none"}};
    size_t n = sizeof own / sizeof own[0];
    for (size_t i = 0; i < n; i++)
        options[i] = own[i];
    n += cmd_dma_options(&s->dma, options + n);
    n += cmd_read_dma_options(&s->read, options + n);
    n += cmd_read_units_option(&s->read, options + n);
    return n;
}

static wt_status read_material(cmd_sliding *s, const cmd_common *common, wt_error *err)
{
    if (s->material == NULL) {
        wt_file_set set = {0};
        set.patterns = s->dma_files.items;
        set.n_patterns = s->dma_files.n;
        set.read = cmd_read_make(&s->read, common);
        cmd_dma_finish(&s->dma);
        s->dma.job.sets = &set;
        s->dma.job.n_sets = 1;
        wt_status status =
            wt_master_make(&s->dma.job, s->poisson_ratio, &s->work, NULL, &s->rubber, err);
        s->dma.job.sets = NULL;
        return status;
    }
    const wt_table *prony = NULL;
    wt_status status = cmd_tables_read(s->material, &s->material_tables, err);
    if (status == WT_OK)
        status = cmd_tables_find(s->material_tables, s->material, "prony", "master", &prony, err);
    if (status == WT_OK)
        status = wt_rubber_from_tables(prony, wt_result_find(s->material_tables, "shift_factors"),
                                       s->poisson_ratio, &s->rubber, err);
    if (status != WT_OK)
        wt_error_file(err, s->material);
    return status;
}

int cmd_sliding_open(cmd_sliding *s, const char *name, const cmd_common *common, int argc,
                     int first)
{
    wt_error err = WT_ERROR_INIT;
    if (first != argc)
        return cmd_usage_error(name, "there is an argument too many; files go with --material or "
                                     "--dma");
    if ((s->material == NULL) == (s->dma_files.n == 0))
        return cmd_usage_error(name, "give either --material FILE or --dma FILE");
    if (s->material != NULL && !isnan(s->read.temperature))
        return cmd_usage_error(name, "--temperature is that of --dma files; the rubber's while it "
                                     "slides is --sliding-temperature");
    if (s->roughness == NULL)
        return cmd_usage_error(name, "--roughness is missing");
    if (isnan(s->conditions.pressure.value))
        return cmd_usage_error(name, "--pressure is missing");
    if (s->velocity.n == 0)
        return cmd_usage_error(name, "--velocity is missing");

    s->log = wt_parselog_new();
    s->result = wt_result_new();
    if (s->log == NULL || s->result == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        return cmd_fail(name, &err);
    }
    if (wt_formats_new(common->formats, &s->formats, s->log, &err) != WT_OK)
        return cmd_fail(name, &err);
    const int format_status = cmd_check_format(name, common, s->formats);
    if (format_status != CMD_OK)
        return format_status;
    s->work.formats = s->formats;
    s->work.threads = (unsigned)common->threads;
    s->work.seed = common->seed;
    s->work.replicates = s->replicates;
    s->work.log = s->log;
    s->work.provenance = wt_result_provenance(s->result);
    const wt_read_options read = cmd_read_make(&s->read, common);
    wt_status opened = read_material(s, common, &err);
    if (opened == WT_OK) {
        opened = wt_surface_open(s->roughness, &read, &s->work, &s->surface, &err);
        if (opened == WT_E_NOT_FOUND)
            wt_error_advice(&err, "--roughness takes a spectrum file or "
                                  "self-affine:q0=..,qr=..,q1=..,hurst=..,c0=..");
    }
    if (opened != WT_OK) {
        cmd_print_log(name, s->log, false, common->quiet);
        return cmd_fail(name, &err);
    }
    s->conditions.rubber = &s->rubber;
    s->conditions.surface = &s->surface;
    s->conditions.velocity = s->velocity.values;
    s->conditions.n_velocity = s->velocity.n;
    return CMD_OK;
}
