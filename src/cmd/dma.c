/* weartrack master, ramp and payne: DMA files to master curve, glass transition and softening.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include <string.h>

/* ---- master ---------------------------------------------------------------------------------- */

typedef struct saved_shifts {
    const char *read, *written;
    bool influence;
} saved_shifts;

static const wt_param saved_rows[] = {
    {PARAM_TEXT_OF("shifts", saved_shifts, read), .value = "FILE", .unset = "fitted",
     .flags = PARAM_READ,
     .help =
         "table with columns temperature and log_a, as --save-shifts writes it: these shifts are "
         "not fitted, those of other isotherms are, and with a column log_b so are the vertical "
         "ones; - is standard input"},
    {PARAM_TEXT_OF("save-shifts", saved_shifts, written), .value = "FILE", .unset = "",
     .help = "write the table shift_factors there too, as a text stream"},
    {PARAM_FLAG_OF("influence", saved_shifts, influence),
     .help =
         "fit again without each of the isotherms: the table influences says how far that moves "
         "the others, law and moduli"},
};
CMD_OPTIONS(saved_params, saved_shifts, saved_rows)

/* Options of the export to finite-element programs. */
typedef struct fem_exports {
    const char *const *exports;
    size_t n_exports;
    wt_fem_export_options solid;
    wt_reduction reduction;
} fem_exports;

static fem_exports export_defaults(void)
{
    return (fem_exports){.solid = wt_fem_export_options_defaults(),
                         .reduction = wt_reduction_defaults()};
}

static const wt_param export_rows[] = {
    {PARAM_TEXTS_OF("export", fem_exports, exports, n_exports), .value = "PROGRAM:FILE",
     .unset = "",
     .help = "write the reduced series with its shifts as the material of a program for finite "
             "elements: abaqus, ansys, code_aster, ls-dyna, openradioss, or as a plain table; "
             "repeatable"},
};
PARAM_LOCAL_TABLE(exported_params, fem_exports, export_rows, export_defaults,
                  PARAM_PART(wt_reduction_params, fem_exports, reduction),
                  PARAM_PART(wt_fem_export_options_params, fem_exports, solid))

static wt_status save_shifts(const char *path, const wt_table *shifts, wt_error *err)
{
    cmd_sink sink;
    wt_status status = cmd_sink_open(path, &sink, err);
    if (status == WT_OK)
        status = wt_stream_write(sink.stream, shifts, NULL, err);
    return cmd_sink_close(&sink, status, err);
}

/* Splits PROGRAM:FILE at the colon. */
static bool split_export(const char *text, wt_fem_program *program, const char **file)
{
    const char *colon = strchr(text, ':');
    *file = colon != NULL ? colon + 1 : "";
    return **file != '\0' && wt_fem_program_find(text, (size_t)(colon - text), program);
}

/* Rejects two outputs to the same file or to standard output. */
static bool check_outputs(cmd_session *s, const saved_shifts *saved,
                          const fem_exports *exports_given)
{
    const char *result = s->common.output != NULL ? s->common.output : "-";
    for (size_t i = 0; i <= exports_given->n_exports; i++) {
        wt_fem_program program;
        const char *one = saved->written, *other;
        if (i < exports_given->n_exports &&
            !split_export(exports_given->exports[i], &program, &one))
            return false;
        bool twice = one != NULL && strcmp(one, result) == 0;
        for (size_t k = 0; k < i && one != NULL; k++)
            twice = twice || (split_export(exports_given->exports[k], &program, &other) &&
                              strcmp(one, other) == 0);
        if (twice && strcmp(one, "-") == 0)
            return cmd_usage_error(s, "two outputs cannot both go to standard output; give -o FILE "
                                      "or the names of others");
        if (twice)
            return cmd_usage_error(s, "%s is given for two outputs; give another name", one);
    }
    return true;
}

/* Checks the exports before the computation. */
static bool check_exports(cmd_session *s, const fem_exports *exports_given)
{
    for (size_t i = 0; i < exports_given->n_exports; i++) {
        wt_fem_program program;
        const char *file;
        if (!split_export(exports_given->exports[i], &program, &file))
            return cmd_usage_error(s,
                                   "--export %s: expected abaqus, ansys, code_aster, ls-dyna, "
                                   "openradioss or table, a "
                                   "colon and the name of a file, such as abaqus:rubber.inp",
                                   exports_given->exports[i]);
        if (wt_fem_export_check(program, &exports_given->solid, &s->err) != WT_OK)
            return cmd_param_error(s);
    }
    return true;
}

static wt_status write_exports(cmd_session *s, const fem_exports *exports_given,
                               const wt_master_tables *tables)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < exports_given->n_exports; i++) {
        wt_fem_program program = WT_FEM_TABLE;
        const char *file;
        cmd_sink sink;
        (void)split_export(exports_given->exports[i], &program, &file);
        status = cmd_sink_open(file, &sink, &s->err);
        if (status == WT_OK)
            status = wt_fem_export(sink.stream, program, tables->prony_reduced,
                                   tables->shift_factors, &exports_given->solid, &s->err);
        status = cmd_sink_close(&sink, status, &s->err);
    }
    return status;
}

/* True if the reduced series is requested. It takes several times as long as the fit. */
static bool requests_reduced_series(const cmd_option_group *part, const fem_exports *exports_given)
{
    static const char *const options[] = {"prony-terms", "prony-error", "prony-long-term"};
    bool asked = exports_given->n_exports > 0;
    for (size_t i = 0; i < COUNT_OF(options); i++)
        asked = asked || cmd_option_is_set(part, options[i]);
    return asked;
}

/* Reads the shifts from an output of master, for the sample if it has several, or from any other
 * table. `shifts` is a table of `given`. */
static wt_status read_saved_shifts(cmd_session *s, const char *path, const char *sample,
                                   wt_result **given, const wt_table **shifts)
{
    static const wt_tables_role role = {
        NULL, WT_ROLE_SHIFTS,
        "what weartrack master wrote, or a text table that begins with a line such as "
        "\"# temperature[degC]<TAB>log_a[1]\""};
    const wt_status status = wt_tables_read(path, path, &s->work, role, given, &s->err);
    if (*given == NULL)
        return status;
    const bool of_samples = cmd_tables_contain(*given, "shift_factors/");
    *shifts = of_samples ? cmd_sample_table(*given, "shift_factors", sample)
                         : wt_result_find(*given, "shift_factors");
    if (*shifts == NULL)
        *shifts = wt_result_table(*given, 0);
    return of_samples ? cmd_check_sample(*given, path, "shift_factors", sample, &s->err) : status;
}

/* Fits one sample, writes its separate files and finishes the call. `status` is the status of
 * reading. */
/* ---- several samples ------------------------------------------------------------------------- */

enum { TABLES = 8, NAME_SIZE = 48 };

typedef struct sample_fit {
    wt_master_tables tables;
    wt_table *named[TABLES]; /* owned after renaming */
    char name[NAME_SIZE];    /* suffix of its tables */
    bool fitted;
} sample_fit;

static bool is_duplicate_name(const sample_fit *fits, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (strcmp(fits[k].name, fits[i].name) == 0)
            return true;
    return false;
}

/* Sets a suffix with the characters allowed in table names; a duplicate has a number appended. */
static void set_table_suffix(sample_fit *fits, size_t i, const char *sample)
{
    char *const name = fits[i].name;
    size_t n = 0;
    for (; *sample != '\0' && n < NAME_SIZE - 8; sample++) {
        const char c = *sample >= 'A' && *sample <= 'Z' ? (char)(*sample - 'A' + 'a') : *sample;
        const bool good = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (good || (n > 0 && name[n - 1] != '_'))
            name[n++] = good ? c : '_';
    }
    while (n > 0 && name[n - 1] == '_')
        n--;
    if (n == 0)
        n = (size_t)snprintf(name, NAME_SIZE, "unnamed");
    name[n] = '\0';
    for (size_t number = 2; is_duplicate_name(fits, i); number++)
        snprintf(name + n, NAME_SIZE - n, "_%zu", number);
}

static const char *display_name(const char *sample)
{
    return sample[0] != '\0' ? sample : "sweeps without a sample";
}

static wt_status rename_sample_tables(sample_fit *f, wt_error *err)
{
    wt_table **const made[TABLES] = {
        &f->tables.prony,         &f->tables.prony_reduced, &f->tables.relaxation_spectrum,
        &f->tables.shift_factors, &f->tables.master_curve,  &f->tables.material_draws,
        &f->tables.series_draws,  &f->tables.influences};
    wt_status status = WT_OK;
    for (size_t k = 0; k < TABLES && status == WT_OK; k++) {
        char name[NAME_SIZE + 32];
        if (*made[k] == NULL)
            continue;
        snprintf(name, sizeof name, "%s/%s", wt_table_name(*made[k]), f->name);
        status = wt_table_rename(*made[k], name, err);
        f->named[k] = *made[k];
        *made[k] = NULL;
    }
    return status;
}

static wt_status fit_sample(cmd_session *s, wt_master_job *job, wt_file_set *set,
                            const char *sample, sample_fit *f)
{
    wt_log *const log = wt_log_new();
    wt_error failure = WT_ERROR_INIT;
    wt_job work = s->work;
    set->read.sample = sample;
    work.log = log;
    wt_status status = wt_master_compute(job, &work, &f->tables, NULL, &failure);
    f->fitted = status == WT_OK;
    wt_log_append(s->work.log, log, display_name(sample));
    wt_log_free(log);
    return status == WT_OK
               ? WT_OK
               : wt_job_add_failure(&s->work, display_name(sample), status, &failure, &s->err);
}

/* Fits each sample. One that cannot be fitted is listed as a failure; it is an error only if no
 * sample can. */
static wt_status fit_all_samples(cmd_session *s, wt_master_job *job, wt_file_set *set,
                                 const wt_sample_names *samples, sample_fit *fits)
{
    size_t n_fitted = 0;
    for (size_t i = 0; i < samples->n; i++) {
        const wt_status status = fit_sample(s, job, set, samples->name[i], &fits[i]);
        if (status != WT_OK)
            return status;
        set_table_suffix(fits, i, samples->name[i]);
        n_fitted += fits[i].fitted;
    }
    return n_fitted > 0 ? WT_OK : wt_fail(&s->err, WT_E_EMPTY, "no sample has a master curve");
}

/* Fits each sample and finishes the call. `set` is the file set of the job. */
static void fit_sample_masters(cmd_session *s, wt_master_job *job, wt_file_set *set,
                               const wt_sample_names *samples)
{
    sample_fit *fits = wt_alloc(samples->n, sizeof *fits);
    wt_table ***made_tables = wt_alloc(samples->n * TABLES, sizeof *made_tables);
    const char *const chosen = set->read.sample;
    size_t n = 0;
    wt_status status = fit_all_samples(s, job, set, samples, fits);
    set->read.sample = chosen;
    for (size_t i = 0; status == WT_OK && i < samples->n; i++) {
        status = rename_sample_tables(&fits[i], &s->err);
        for (size_t k = 0; k < TABLES; k++)
            made_tables[n++] = &fits[i].named[k];
    }
    s->next = "friction --material@ --sample NAME, or compare BULK TRACK --master@ "
              "--sample NAME";
    cmd_finish(s, status, made_tables, n);
    for (size_t i = 0; i < samples->n; i++) {
        wt_master_tables_clear(&fits[i].tables);
        for (size_t k = 0; k < TABLES; k++)
            wt_table_free(fits[i].named[k]);
    }
    free(made_tables);
    free(fits);
}

/* ---- one sample ------------------------------------------------------------------------------ */

static void fit_single_master(cmd_session *s, wt_status status, const wt_master_job *job,
                              const saved_shifts *saved, const fem_exports *exports_given)
{
    wt_master_tables tables = {0};
    if (status == WT_OK)
        status = wt_master_compute(job, &s->work, &tables, NULL, &s->err);
    if (status == WT_OK && saved->written != NULL)
        status = save_shifts(saved->written, tables.shift_factors, &s->err);
    if (status == WT_OK)
        status = write_exports(s, exports_given, &tables);
    wt_table **const made_tables[] = {
        &tables.prony,         &tables.prony_reduced, &tables.relaxation_spectrum,
        &tables.shift_factors, &tables.master_curve,  &tables.material_draws,
        &tables.series_draws,  &tables.influences};
    cmd_finish(s, status, made_tables, COUNT_OF(made_tables));
    wt_master_tables_clear(&tables);
}

int cmd_master(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "master",
        .next = "friction --material@, or compare BULK TRACK --master@",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Fits one relaxation spectrum to all isotherms of DMA frequency sweeps, with their "
            "shifts, the law of these and the errors of everything; says whether superposition "
            "holds. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .first = "reference-temperature shift-law vertical-shift exclude liquid temperature "
                 "units sheet deformation strain sample export prony-terms output",
        .notes =
            "The tables prony, relaxation_spectrum, shift_factors and master_curve follow one "
            "another, then draws of all that is not known of the material, material_draws and "
            "series_draws; with --prony-error, --prony-terms, --prony-long-term or --export "
            "prony_reduced, too (few terms in place of prony). "
            "weartrack friction, layer and compare read them as they are. Where the files name "
            "several samples, each has such tables with its name behind theirs, as in "
            "prony/nr_50.",
        .n_files = CMD_ONE_OR_MORE};
    wt_master_job job = wt_master_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    saved_shifts saved = {NULL, NULL, false};
    fem_exports exports_given = export_defaults();
    enum { EXPORTED = 2 };
    cmd_option_group parts[] = {
        {wt_master_job_params(), &job,
         "reference-temperature reference-at vertical-shift expansion "
         "sample-temperature-error terms-per-decade liquid "
         "shift-by exclude shift-law shift",
         0},
        {saved_params(), &saved, NULL, 0},
        [EXPORTED] = {exported_params(), &exports_given, NULL, 0},
        {wt_read_params(), &set.read,
         "temperature temperature-in-name frequency units format sheet deformation strain sample "
         "sample-by conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_result *given = NULL;
    wt_sample_names samples = {0, NULL};
    wt_sweep sweep = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        !check_exports(&s, &exports_given) || !check_outputs(&s, &saved, &exports_given) ||
        !cmd_begin_files(&s, &set))
        return cmd_session_free(&s);
    job.reduction = exports_given.reduction;
    if (!requests_reduced_series(&parts[EXPORTED], &exports_given))
        s.work.left_out |= WT_EXTRA_REDUCED_SERIES;
    if (!saved.influence)
        s.work.left_out |= WT_EXTRA_INFLUENCES;
    job.sets = &set;
    job.n_sets = 1;
    wt_cost_begin_stage(s.cost, "master_curve");
    s.work.dma = &sweep; /* read once for all samples */
    wt_status status = WT_OK;
    if (saved.read != NULL)
        status = read_saved_shifts(&s, saved.read, set.read.sample, &given, &job.shifts);
    /* separate files are for one sample only */
    if (status == WT_OK && set.read.sample == NULL && saved.written == NULL &&
        exports_given.n_exports == 0)
        status = wt_sample_names_read(&set, 1, &s.work, &samples, &s.err);
    job.shifts_file = samples.n > 1 ? NULL : saved.read;
    if (status == WT_OK && samples.n > 1)
        fit_sample_masters(&s, &job, &set, &samples);
    else
        fit_single_master(&s, status, &job, &saved, &exports_given);
    wt_sample_names_clear(&samples);
    wt_sweep_clear(&sweep);
    wt_result_free(given);
    return cmd_session_free(&s);
}

/* ---- ramp ------------------------------------------------------------------------------------ */

int cmd_ramp(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "ramp",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Determines the glass transition from DMA temperature sweeps: the temperatures of the "
            "peaks of tan delta and of the loss modulus at each frequency, with their errors. With "
            "--at it also reports the moduli and tan delta at these temperatures. Isotherms are "
            "split by frequency. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables glass_transition, moduli_at (with --at) and ramp follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_ramp_job job = wt_ramp_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_ramp_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read,
         "temperature-in-name frequency units format sheet deformation strain sample sample-by "
         "conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_ramp_tables made = {0};
    wt_table **const tables[] = {&made.glass_transition, &made.moduli_at, &made.ramp};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_ramp_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}

/* ---- payne ----------------------------------------------------------------------------------- */

int cmd_payne(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "payne",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Determines from DMA strain sweeps how a filled rubber softens with the strain "
            "amplitude (Payne effect), at each frequency and temperature: moduli relative to those "
            "of the smallest amplitudes, the amplitudes at which the storage modulus has lost a "
            "tenth and half, and the maximum of the loss modulus. Folders and patterns are "
            "allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables payne and payne_sweep follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_payne_job job = wt_payne_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_read_params(), &set.read,
         "units format sheet temperature temperature-in-name frequency deformation "
         "sample sample-by conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_payne_tables made = {0};
    wt_table **const tables[] = {&made.payne, &made.payne_sweep};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_payne_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
