/* Options for rubber, counter surface and conditions. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "cmd/sliding_options.h"
#include "cmd/table_output.h"

static const wt_param contact_rows[] = {
    {PARAM_TEXT_OF("material", cmd_contact, material), .value = "FILE", .letter = 'm', .unset = "",
     .help =
         "output of weartrack master (text stream or .h5; - is standard input), a text table of "
         "E' and E'' at one temperature, or fractional-zener:e0=..Pa,eg=..Pa,tau=..s,alpha=.."},
    {PARAM_TEXTS_OF("dma", cmd_contact, dma_files, n_dma), .value = "FILE", .unset = "",
     .help = "DMA file, folder or pattern instead of --material; repeatable"},
    {PARAM_TEXT_OF("roughness", cmd_contact, roughness), .value = "R", .flags = PARAM_REQUIRED,
     .help = "counter surface: self-affine:q0=..rad/m,qr=..rad/m,q1=..rad/m,hurst=..,c0=..m^4, a "
             "spectrum file, or height maps of it: a file, or a folder or pattern of several"},
    {PARAM_TEXT_OF("strain-softening", cmd_contact, softening), .value = "FILE", .unset = "",
     .help = "how the moduli soften with strain: output of weartrack payne, or a table with "
             "columns strain, f and g (and f_error, g_error), by which E' and E'' are multiplied"},
    {PARAM("softening-temperature", cmd_contact, softening_temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "they are of one",
     .help = "of strain sweeps at several temperatures take those nearest to this one"},
    {PARAM_TEXT_OF("layer-comparison", cmd_contact, layer_comparison), .value = "FILE", .unset = "",
     .help = "output of weartrack compare, whose modulus ratios at several indentation rates are "
             "those of the layer, instead of --modulus-ratio"},
    {PARAM_TEXT_OF("wear-of", cmd_contact, wear_of), .value = "FILE", .unset = "",
     .help = "output of weartrack record, whose specific wear rate is that of the layer unless "
             "--specific-wear-rate gives one"},
};

static cmd_contact contact_defaults(void)
{
    return (cmd_contact){.softening_temperature = (double)NAN};
}
PARAM_LOCAL_TABLE(contact_params, cmd_contact, contact_rows, contact_defaults, NO_PARTS)

void cmd_sliding_init(cmd_sliding *s, cmd_option_group own)
{
    memset(s, 0, sizeof *s);
    s->conditions = wt_sliding_defaults();
    s->master = wt_master_job_defaults();
    s->set.read = wt_read_defaults();
    s->session = cmd_session_defaults();
    s->contact = contact_defaults();
    s->parts[CMD_CONTACT] =
        (cmd_option_group){contact_params(), &s->contact,
                           "material dma roughness strain-softening softening-temperature "
                           "layer-comparison",
                           0};
    s->parts[CMD_CONDITIONS] = (cmd_option_group){wt_sliding_params(), &s->conditions, NULL, 0};
    s->parts[CMD_WORK] = (cmd_option_group){wt_job_params(), &s->session.work, NULL, 0};
    s->parts[CMD_MASTER] =
        (cmd_option_group){wt_master_job_params(), &s->master,
                           "poisson-ratio reference-temperature shift-law vertical-shift", 0};
    s->parts[CMD_READ] = (cmd_option_group){
        wt_read_params(), &s->set.read,
        "temperature temperature-in-name units pixel-size height-unit format sheet deformation "
        "sample spectrum-convention conditioning",
        0};
    s->parts[CMD_SUBCOMMAND] = own;
}

int cmd_sliding_free(cmd_sliding *s)
{
    wt_rubber_clear(&s->rubber);
    wt_surface_clear(&s->surface);
    wt_strain_softening_clear(&s->strain_softening);
    wt_result_free(s->material_tables);
    wt_result_free(s->layer_tables);
    return cmd_session_free(&s->session);
}

/* Checks that one source of the layer modulus is given. */
static bool check_layer_modulus(cmd_sliding *s)
{
    return s->contact.layer_comparison == NULL ||
           !cmd_option_is_set(&s->parts[CMD_SUBCOMMAND], "modulus-ratio") ||
           cmd_usage_error(&s->session, "give one of --modulus-ratio and --layer-comparison");
}

bool cmd_sliding_parse(cmd_sliding *s, const cmd_usage *usage, int argc, char **argv)
{
    cmd_session *session = &s->session;
    if (!cmd_parse(session, usage, s->parts, CMD_SLIDING_PARTS, argc, argv))
        return false;
    if (session->n_arguments > 0)
        return cmd_usage_error(session, "there is an argument too many; files go with --material "
                                        "or --dma");
    if ((s->contact.material != NULL) + (s->contact.n_dma > 0) + (session->n_files > 0) != 1)
        return cmd_usage_error(session, "give either --material FILE or --dma FILE (or the names "
                                        "of DMA files with --files-from)");
    if (s->contact.softening == NULL &&
        cmd_option_is_set(&s->parts[CMD_CONTACT], "softening-temperature"))
        return cmd_usage_error(session, "--softening-temperature goes with --strain-softening");
    if (!check_layer_modulus(s))
        return false;
    if (s->contact.material != NULL && cmd_option_is_set(&s->parts[CMD_READ], "temperature"))
        return cmd_usage_error(session, "--temperature is that of --dma files; the rubber's while "
                                        "it slides is --sliding-temperature");
    return true;
}

static wt_status fit_sliding_material(cmd_sliding *s, wt_error *err)
{
    wt_master_tables tables = {0};
    const bool listed = s->session.n_files > 0;
    s->set.patterns = listed ? s->session.files : s->contact.dma_files;
    s->set.n_patterns = listed ? s->session.n_files : s->contact.n_dma;
    s->master.sets = &s->set;
    s->master.n_sets = 1;
    wt_job work = s->session.work;
    work.left_out |=
        WT_EXTRA_REDUCED_SERIES | WT_EXTRA_SPECTRUM | WT_EXTRA_MASTER_CURVE | WT_EXTRA_INFLUENCES;
    if (work.replicates < 2)
        work.left_out |= WT_EXTRA_DRAWS;
    wt_status status = wt_master_compute(&s->master, &work, &tables, &s->rubber, err);
    wt_master_tables_clear(&tables);
    return status;
}

/* True if the text is a law and not a file name: its errors are usage errors. */
static bool is_law_text(const char *text)
{
    return text != NULL &&
           (strncmp(text, "self-affine:", 12) == 0 || strncmp(text, "fractional-zener:", 17) == 0);
}

/* Source and destination of a material. */
typedef struct material_input {
    const char *from, *sample;
    wt_result **tables; /* receives the tables of a result */
    wt_rubber *rubber;
} material_input;

/* Reads a material: the series of a result, or the points of its master curve if
 * there is no series. Any other file is read as a table of moduli; if that fails, the first error
 * is reported. */
static wt_status read_sliding_material(const cmd_sliding *s, material_input given, wt_error *err)
{
    const char *const from = given.from, *const sample = given.sample;
    const double poisson = s->master.poisson_ratio;
    wt_error first = WT_ERROR_INIT;
    wt_read_options read = s->set.read;
    read.sample = sample;
    read.temperature = s->master.fit.reference_temperature;
    if (is_law_text(from)) {
        const wt_status law =
            wt_rubber_open(from, &read, poisson, &s->session.work, given.rubber, err);
        given.rubber->prony.reference_temperature = read.temperature;
        return law;
    }
    wt_job work = s->session.work;
    wt_status status =
        cmd_rubber_read(from, sample, poisson, &work, given.tables, given.rubber, &first);
    const wt_table *curve = cmd_sample_table(*given.tables, "master_curve", sample);
    if (curve != NULL && status == WT_E_NOT_FOUND) {
        given.rubber->poisson_ratio = poisson;
        return wt_rubber_tabulate(given.rubber, curve, err);
    }
    const bool of_samples =
        status == WT_E_AMBIGUOUS || cmd_tables_contain(*given.tables, "shift_factors");
    if (status != WT_OK && status != WT_E_MEMORY && !of_samples && strcmp(from, "-") != 0) {
        if (*given.tables != NULL) { /* already in the provenance */
            work.provenance = NULL;
            work.cost = NULL;
        }
        const wt_status table = wt_rubber_open(from, &read, poisson, &work, given.rubber, err);
        if (table != WT_E_FORMAT && table != WT_E_NOT_FOUND)
            return table;
    }
    if (status != WT_OK)
        *err = first;
    return status;
}

bool cmd_sliding_has_layer(const cmd_sliding *s, const cmd_option_group *part)
{
    return cmd_option_is_set(part, "modulus-ratio") || s->contact.layer_comparison != NULL;
}

/* Reads the modulus of the layer from a comparison; only `friction` has the option. */
static wt_status read_layer_modulus(cmd_sliding *s, wt_error *err)
{
    const cmd_contact *c = &s->contact;
    const wt_table *comparison = NULL, *rates = NULL;
    wt_status status = WT_OK;
    status = wt_tables_read(c->layer_comparison, c->layer_comparison, &s->session.work,
                            (wt_tables_role){"modulus of the layer", "modulus of the layer", NULL},
                            &s->layer_tables, err);
    if (status == WT_OK)
        status = cmd_table_find(s->layer_tables, c->layer_comparison, "comparison", "compare",
                                &comparison, err);
    if (status == WT_OK)
        status = cmd_table_find(s->layer_tables, c->layer_comparison, "modulus_rate", "compare",
                                &rates, err);
    return status == WT_OK ? wt_layer_observation_from_rates(
                                 comparison, rates, s->parts[CMD_SUBCOMMAND].structure, err)
                           : status;
}

static wt_status read_wear_rate(cmd_sliding *s, wt_error *err)
{
    const char *const path = s->contact.wear_of;
    const wt_table *wear = NULL;
    wt_result *result = NULL;
    wt_status status = wt_tables_read(
        path, path, &s->session.work,
        (wt_tables_role){"wear of the layer", "wear of the layer", NULL}, &result, err);
    if (status == WT_OK)
        status = cmd_table_find(result, path, "wear", "record", &wear, err);
    if (status == WT_OK && (!wt_table_estimate(wear, "specific_wear_rate", &s->measured_wear) ||
                            isnan(s->measured_wear.value))) {
        status = wt_fail(err, WT_E_EMPTY, "the result has no specific wear rate");
        wt_error_file(err, path);
        wt_error_advice(err, "its table wear says why");
    }
    wt_result_free(result);
    return status;
}

void cmd_sliding_set_wear_rate(cmd_sliding *s, wt_estimate *rate)
{
    const wt_estimate measured = s->measured_wear;
    if (s->contact.wear_of == NULL)
        return;
    if (isnan(rate->value))
        *rate = measured;
    else
        wt_log_add(s->session.log, WT_WARNING, s->contact.wear_of, NULL,
                   "the specific wear rate given is %.3g times the one measured, %.3g m^2/N; "
                   "the one given is taken",
                   rate->value / measured.value, measured.value);
}

bool cmd_sliding_open(cmd_sliding *s)
{
    wt_error *err = &s->session.err;
    wt_job *work = &s->session.work;
    if (!cmd_begin_reading(&s->session, s->set.read.format))
        return false;
    cmd_share_unit_options(&s->session, &s->set.read);
    /* friction needs every input */
    wt_table_free(work->failures);
    work->failures = NULL;
    wt_cost_begin_stage(s->session.cost,
                        s->contact.material != NULL ? "given_material" : "master_curve");
    const material_input bulk = {s->contact.material, s->set.read.sample, &s->material_tables,
                                 &s->rubber};
    wt_status status =
        bulk.from != NULL ? read_sliding_material(s, bulk, err) : fit_sliding_material(s, err);
    if (status == WT_OK && s->contact.material != NULL)
        wt_rubber_add_cost(&s->rubber, work);
    bool wrong_words = status != WT_OK && is_law_text(s->contact.material);
    wt_cost_begin_stage(s->session.cost, "roughness");
    if (status == WT_OK) {
        status = wt_surface_open(s->contact.roughness, &s->set.read, work, &s->surface, err);
        wrong_words = status != WT_OK && is_law_text(s->contact.roughness);
        if (status == WT_E_NOT_FOUND)
            wt_error_advice(err, "--roughness takes a spectrum, height maps or "
                                 "self-affine:q0=..,qr=..,q1=..,hurst=..,c0=..");
    }
    if (status == WT_OK && s->contact.softening != NULL) {
        const wt_strain_softening_choice choice = {.temperature = s->contact.softening_temperature,
                                                   .sample = s->set.read.sample};
        status = wt_strain_softening_read(s->contact.softening, s->contact.softening, choice, work,
                                          &s->strain_softening, err);
        s->conditions.strain_softening = &s->strain_softening;
    }
    if (status == WT_OK && s->contact.layer_comparison != NULL)
        status = read_layer_modulus(s, err);
    if (status == WT_OK && s->contact.wear_of != NULL)
        status = read_wear_rate(s, err);
    s->conditions.rubber = &s->rubber;
    s->conditions.surface = &s->surface;
    if (status != WT_OK)
        cmd_end(&s->session, status);
    if (wrong_words && status != WT_E_MEMORY)
        s->session.status = CMD_USAGE;
    return status == WT_OK;
}
