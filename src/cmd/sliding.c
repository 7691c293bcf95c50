/* weartrack friction, layer and identify, with their options for rubber, counter surface and
 * conditions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include <math.h>
#include <string.h>

/* Sources of rubber and counter surface. */
typedef struct cmd_contact {
    const char *material;         /* output of `master`, a table of moduli or a law */
    const char *const *dma_files; /* [n_dma] or DMA files */
    size_t n_dma;
    const char *roughness;
    const char *softening;        /* output of `payne` or a table; NULL: none */
    double softening_temperature; /* selects sweeps by temperature [K]; NaN: all have one
                                     temperature */
    const char *layer_comparison; /* output of `compare`: layer modulus by rate; NULL: none */
    const char *wear_of;          /* output of `record`: specific wear rate; NULL: none */
} cmd_contact;

/* Options for DMA files, which weartrack master documents. */
#define CMD_DMA_OPTIONS                                                                            \
    "shift-law reference-temperature vertical-shift sample-temperature-error temperature "         \
    "temperature-in-name units format "                                                            \
    "sheet deformation sample conditioning"

/* Option groups; CMD_SUBCOMMAND has those of the subcommand itself. */
enum {
    CMD_CONTACT,
    CMD_CONDITIONS,
    CMD_SUBCOMMAND,
    CMD_WORK,
    CMD_MASTER,
    CMD_READ,
    CMD_SLIDING_PARTS
};

typedef struct cmd_sliding {
    cmd_contact contact;
    wt_sliding conditions;
    wt_master_job master;
    wt_file_set set;
    cmd_session session;
    cmd_option_group parts[CMD_SLIDING_PARTS];
    /* set by cmd_sliding_open */
    wt_result *material_tables, *layer_tables;
    wt_estimate measured_wear; /* from wear_of; value NaN: none */
    wt_rubber rubber;
    wt_surface surface;
    wt_strain_softening strain_softening;
} cmd_sliding;

static const wt_param contact_rows[] = {
    {PARAM_TEXT_OF("material", cmd_contact, material), .value = "FILE", .letter = 'm', .unset = "",
     .flags = PARAM_READ,
     .help =
         "output of weartrack master (text stream or .h5; - is standard input), a text table of "
         "E' and E'' at one temperature, or fractional-zener:e0=..Pa,eg=..Pa,tau=..s,alpha=.."},
    {PARAM_TEXTS_OF("dma", cmd_contact, dma_files, n_dma), .value = "FILE", .unset = "",
     .flags = PARAM_READ, .help = "DMA file, folder or pattern instead of --material; repeatable"},
    {PARAM_TEXT_OF("roughness", cmd_contact, roughness), .value = "R",
     .flags = PARAM_REQUIRED | PARAM_READ,
     .help = "counter surface: self-affine:q0=..rad/m,qr=..rad/m,q1=..rad/m,hurst=..,c0=..m^4, a "
             "spectrum file, or height maps of it: a file, or a folder or pattern of several"},
    {PARAM_TEXT_OF("strain-softening", cmd_contact, softening), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "how the moduli soften with strain: output of weartrack payne, or a table with "
             "columns strain, f and g (and f_error, g_error), by which E' and E'' are multiplied"},
    {PARAM("softening-temperature", cmd_contact, softening_temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "they are of one",
     .help = "of strain sweeps at several temperatures take those nearest to this one"},
    {PARAM_TEXT_OF("layer-comparison", cmd_contact, layer_comparison), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "output of weartrack compare, whose modulus ratios at several indentation rates are "
             "those of the layer, instead of --modulus-ratio"},
    {PARAM_TEXT_OF("wear-of", cmd_contact, wear_of), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "output of weartrack record, whose specific wear rate is that of the layer unless "
             "--specific-wear-rate gives one"},
};

static cmd_contact contact_defaults(void)
{
    return (cmd_contact){.softening_temperature = (double)NAN};
}
PARAM_LOCAL_TABLE(contact_params, cmd_contact, contact_rows, contact_defaults, NO_PARTS)

/* Initialises; `own` has the options of the subcommand itself. */
static void cmd_sliding_init(cmd_sliding *s, cmd_option_group own)
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
                           "poisson-ratio reference-temperature shift-law vertical-shift "
                           "sample-temperature-error",
                           0};
    s->parts[CMD_READ] = (cmd_option_group){
        wt_read_params(), &s->set.read,
        "temperature temperature-in-name units pixel-size height-unit format sheet deformation "
        "sample spectrum-convention conditioning",
        0};
    s->parts[CMD_SUBCOMMAND] = own;
}

static int cmd_sliding_free(cmd_sliding *s)
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

/* As cmd_parse. */
static bool cmd_sliding_parse(cmd_sliding *s, const cmd_usage *usage, int argc, char **argv)
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
    const cmd_option_group *fit = &s->parts[CMD_MASTER];
    if (s->contact.material != NULL && (cmd_option_is_set(fit, "vertical-shift") ||
                                        cmd_option_is_set(fit, "sample-temperature-error")))
        return cmd_usage_error(session, "--vertical-shift and --sample-temperature-error are of "
                                        "the fit of --dma files; give them to weartrack master");
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

/* True if the call states the modulus of a layer; `part` has the layer options. */
static bool cmd_sliding_has_layer(const cmd_sliding *s, const cmd_option_group *part)
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
                            (wt_tables_role){.role = WT_ROLE_LAYER_MODULUS}, &s->layer_tables, err);
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
    wt_status status = wt_tables_read(path, path, &s->session.work,
                                      (wt_tables_role){.role = WT_ROLE_LAYER_WEAR}, &result, err);
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

/* Sets the specific wear rate from --wear-of if none is given. A given one takes precedence, with a
 * warning that states the ratio. */
static void cmd_sliding_set_wear_rate(cmd_sliding *s, wt_estimate *rate)
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

/* Begins the session, reads material and roughness and fills `conditions`. False on failure, which
 * has been reported. */
static bool cmd_sliding_open(cmd_sliding *s)
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

/* ---- friction -------------------------------------------------------------------------------- */

/* The tables that follow that of friction, each where it has something to say. */
enum { AREA, TRANSVERSE_ISOTROPY, SOFTENING, FLASH, DECADES, N_FURTHER };

static bool is_table_requested(const wt_sliding *s, size_t k)
{
    switch (k) {
    case TRANSVERSE_ISOTROPY:
        return s->rubber->is_transverse;
    case SOFTENING:
        return s->strain_softening != NULL;
    case FLASH:
        return s->flash.on;
    case DECADES:
        return s->decades;
    default:
        return true;
    }
}

static wt_status compute_further_tables(cmd_sliding *s, wt_table *further[N_FURTHER])
{
    static const struct {
        const char *stage;
        wt_status (*compute)(const wt_sliding *, const wt_job *, wt_table **, wt_error *);
    } made[N_FURTHER] = {
        [AREA] = {"contact_area", wt_contact_area_compute},
        [TRANSVERSE_ISOTROPY] = {"transverse_isotropy", wt_transverse_isotropy_compute},
        [SOFTENING] = {"softening", wt_softened_friction_compute},
        [FLASH] = {"flash_temperature", wt_flash_temperature_compute},
        [DECADES] = {"friction_decades", wt_friction_by_scale_compute}};
    wt_status status = WT_OK;
    for (size_t k = 0; status == WT_OK && k < N_FURTHER; k++) {
        if (!is_table_requested(&s->conditions, k))
            continue;
        wt_cost_begin_stage(s->session.cost, made[k].stage);
        status = made[k].compute(&s->conditions, &s->session.work, &further[k], &s->session.err);
    }
    return status;
}

int cmd_friction(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "friction",
        .next = "layer with these options, a wear rate and a critical energy",
        .arguments = "--material FILE --roughness R --pressure P --velocity V [OPTION]...",
        .description =
            "Persson's hysteresis friction, contact area and, with --shear-stress, total "
            "friction at each velocity, each with its numerical and its standard error; with a "
            "modified layer on top if its thickness and modulus ratio are given.",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity sliding-temperature shear-stress "
                 "layer-thickness modulus-ratio strain-softening flash-temperature "
                 "output",
        .master = CMD_DMA_OPTIONS};
    wt_layer_observation layer = wt_layer_observation_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_option_group){wt_layer_observation_params(), &layer, NULL, 0});
    const cmd_option_group *own = &s.parts[CMD_SUBCOMMAND];
    wt_friction_tables tables = {0};
    wt_table *further[N_FURTHER] = {NULL}, *what_if = NULL;
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    const bool has_layer = cmd_option_is_set(own, "layer-thickness");
    if (has_layer != cmd_sliding_has_layer(&s, own))
        cmd_usage_error(&s.session, "--layer-thickness and --modulus-ratio (or a file of it) go "
                                    "together");
    else if (cmd_sliding_open(&s)) {
        const wt_layer_observation *observation = has_layer ? &layer : NULL;
        wt_cost_begin_stage(s.session.cost, has_layer ? "friction_with_layer" : "friction");
        wt_status status = wt_sliding_friction_compute(&s.conditions, observation, &s.session.work,
                                                       &tables, &s.session.err);
        if (status == WT_OK)
            status = compute_further_tables(&s, further);
        wt_cost_begin_stage(s.session.cost, "what_if");
        if (status == WT_OK)
            status = wt_model_sensitivity_compute(&s.conditions, NULL, observation, &s.session.work,
                                                  &what_if, &s.session.err);
        wt_table **const parts[] = {&tables.friction,
                                    &further[AREA],
                                    &further[TRANSVERSE_ISOTROPY],
                                    &further[SOFTENING],
                                    &further[FLASH],
                                    &further[DECADES],
                                    &what_if};
        cmd_finish(&s.session, status, parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}

/* ---- layer ----------------------------------------------------------------------------------- */

/* Output tables, each if requested. */
enum { LAYER, ENERGY_DENSITY, LAYER_SOFTENING, LAYER_FLASH, WHAT_IF, N_TABLES };

static wt_status compute_layer_tables(cmd_sliding *s, const wt_layer_job *job,
                                      wt_layer_tables *tables, wt_table *table[N_TABLES])
{
    const wt_job *work = &s->session.work;
    wt_error *err = &s->session.err;
    wt_cost_begin_stage(s->session.cost, "layer");
    wt_status status = wt_layer_thickness_compute(&s->conditions, job, work, tables, err);
    table[LAYER] = tables->layer;
    tables->layer = NULL;
    wt_cost_begin_stage(s->session.cost, "energy_density");
    if (status == WT_OK)
        status = wt_energy_density_compute(&s->conditions, job, work, &table[ENERGY_DENSITY], err);
    if (status == WT_OK && s->conditions.strain_softening != NULL) {
        wt_cost_begin_stage(s->session.cost, "softening");
        status = wt_softened_friction_compute(&s->conditions, work, &table[LAYER_SOFTENING], err);
    }
    if (status == WT_OK && s->conditions.flash.on) {
        wt_cost_begin_stage(s->session.cost, "flash_temperature");
        status = wt_flash_temperature_compute(&s->conditions, work, &table[LAYER_FLASH], err);
    }
    wt_cost_begin_stage(s->session.cost, "what_if");
    if (status == WT_OK)
        status =
            wt_model_sensitivity_compute(&s->conditions, job, NULL, work, &table[WHAT_IF], err);
    return status;
}

int cmd_layer(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "layer",
        .arguments = "--material FILE --roughness R --pressure P --velocity V "
                     "{--specific-wear-rate K | --wear-of FILE} [--critical-energy U | "
                     "--observed-thickness D] [OPTION]...",
        .description =
            "Energy density with depth, formation and wear rate, balance and thickness in time "
            "of the modified layer, at constant load and the velocity given (the middle one of a "
            "list).",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity sliding-temperature "
                 "specific-wear-rate critical-energy observed-thickness duty-cycle times "
                 "energy-from output",
        .master = CMD_DMA_OPTIONS};
    wt_layer_job job = wt_layer_job_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_option_group){wt_layer_job_params(), &job, NULL, 0});
    s.parts[CMD_CONTACT].only =
        "material dma roughness strain-softening softening-temperature wear-of";
    s.parts[CMD_CONDITIONS].only = "pressure velocity sliding-temperature "
                                   "flash-temperature contact-size heat-capacity "
                                   "heat-diffusivity shear-stress";
    wt_layer_tables tables = {0};
    wt_table *table[N_TABLES] = {NULL};
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    if (s.contact.wear_of == NULL && wt_layer_job_check(&job, &s.session.err) != WT_OK)
        cmd_param_error(&s.session);
    else if (cmd_sliding_open(&s)) {
        cmd_sliding_set_wear_rate(&s, &job.specific_wear_rate);
        const wt_status status = compute_layer_tables(&s, &job, &tables, table);
        wt_table **parts[N_TABLES];
        for (size_t i = 0; i < N_TABLES; i++)
            parts[i] = &table[i];
        cmd_finish(&s.session, status, parts, N_TABLES);
    }
    return cmd_sliding_free(&s);
}

/* ---- identify -------------------------------------------------------------------------------- */

int cmd_identify(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "identify",
        .arguments = "--material FILE --roughness R --pressure P --velocity V --observed-thickness "
                     "D [--specific-wear-rate K] [--running-in-time T] [OPTION]...",
        .description =
            "Critical energy U_c and specific wear rate k that go with a layer of known "
            "thickness: with a wear rate, with the time of its running-in, or both against one "
            "another, at the velocity given (the middle one of a list); with intervals, their "
            "correlation and the combination that the data do not determine.",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity observed-thickness specific-wear-rate "
                 "running-in-time sliding-temperature output",
        .master = CMD_DMA_OPTIONS};
    wt_identify_job job = wt_identify_job_defaults();
    cmd_sliding s;
    wt_table *table = NULL;
    cmd_sliding_init(&s, (cmd_option_group){wt_identify_job_params(), &job, NULL, 0});
    /* the energy does not depend on the shear stress */
    s.parts[CMD_CONTACT].only =
        "material dma roughness strain-softening softening-temperature wear-of";
    s.parts[CMD_CONDITIONS].only = "pressure velocity sliding-temperature "
                                   "flash-temperature contact-size heat-capacity heat-diffusivity";
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    if (cmd_sliding_open(&s)) {
        cmd_sliding_set_wear_rate(&s, &job.specific_wear_rate);
        wt_cost_begin_stage(s.session.cost, "identify");
        wt_table **const parts[] = {&table};
        cmd_finish(
            &s.session,
            wt_identification_compute(&s.conditions, &job, &s.session.work, &table, &s.session.err),
            parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}
