/* Creates and frees a case, and changes it for a call. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case.h"
#include "case/case_schema.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"

#include "core/base/param.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *wt_case_schema(void)
{
    return case_schema[0].text;
}

wt_case *case_new(void)
{
    wt_case *c = wt_alloc(1, sizeof *c);
    c->title = c->sample = c->condition = "";
    c->indent = wt_indent_job_defaults();
    c->compare = wt_compare_job_defaults();
    c->bulk.spring_constant = c->track.spring_constant = (wt_estimate){(double)NAN, 0, 0, "N/m"};
    c->bulk.sensitivity = c->track.sensitivity = (wt_estimate){(double)NAN, 0, 0, "m/V"};
    c->master = wt_master_job_defaults();
    c->ramp = wt_ramp_job_defaults();
    c->zener = flow_zener_defaults();
    c->transverse = wt_transverse_defaults();
    c->surface = flow_surface_defaults();
    c->topography = wt_topography_job_defaults();
    c->sliding = wt_sliding_defaults();
    c->layer = wt_layer_job_defaults();
    c->identify = wt_identify_job_defaults();
    c->records = wt_record_job_defaults();
    c->validation = wt_validation_job_defaults();
    c->report = wt_report_defaults();
    return c;
}

void wt_case_free(wt_case *c)
{
    if (c == NULL)
        return;
    for (case_setting *s = c->settings; s != NULL; s = s->next)
        wt_params_clear(s->params, s->structure, &s->given);
    arena_free(&c->memory);
    free(c);
}

const char *wt_case_title(const wt_case *c)
{
    return c->title;
}

const wt_report_options *wt_case_report_options(const wt_case *c)
{
    return &c->report;
}

wt_status wt_case_request_tables(wt_case *c, const char *tables, wt_error *err)
{
    char *rest = NULL;
    flow_resource_set requested = 0;
    if (c == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no case, or no table");
    wt_status status = WT_OK;
    char *const names = wt_strdup(tables);
    for (const char *name = strtok_r(names, " ", &rest); status == WT_OK && name != NULL;
         name = strtok_r(NULL, " ", &rest)) {
        flow_resource_set resources = 0;
        if (!flow_table_resources(name, &resources) || resources == 0)
            status = wt_fail(err, WT_E_NOT_FOUND, "no table of a run is called \"%s\"", name);
        requested |= resources;
    }
    free(names);
    if (status == WT_OK && requested == 0)
        status = wt_fail(err, WT_E_NOT_FOUND, "no table of a run is called \"%s\"", tables);
    if (status != WT_OK)
        return status;
    c->is_explicit_request = c->has_requests = true;
    c->requested = requested;
    return WT_OK;
}

static void replace_records(wt_case *c, const char *const *records, size_t n)
{
    const bool known = c->record.n > 0;
    wt_file_set *const sets = arena_alloc(&c->memory, n, sizeof *sets);
    const char **const patterns = arena_alloc(&c->memory, n, sizeof *patterns);
    for (size_t i = 0; i < n; i++) {
        patterns[i] = arena_text(&c->memory, records[i], strlen(records[i]));
        sets[i] =
            (wt_file_set){.patterns = &patterns[i], .n_patterns = 1, .read = wt_read_defaults()};
    }
    c->record.sets = sets;
    c->record.n = n;
    if (!known) {
        c->record.next = c->roles;
        c->roles = &c->record;
    }
}

wt_status wt_case_set_validation(wt_case *c, const char *const *records, size_t n,
                                 const wt_validation_job *job, uint64_t given, wt_error *err)
{
    if (c == NULL || job == NULL || (n > 0 && records == NULL))
        return wt_fail(err, WT_E_ARG, "no case, or no validation job");
    param_copy(wt_validation_job_params(), job, given, &c->validation);
    if (n > 0)
        replace_records(c, records, n);
    return WT_OK;
}
