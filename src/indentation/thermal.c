/* Job of the thermal noise method: spectra of free cantilevers to spring constants.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/base/param.h"
#include "core/math/students_t.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double boltzmann = 1.380649e-23; /* [J/K], exact */
static const double room_temperature =
    298.15; /* [K]; a difference of 10 K changes a spring constant by 3 % */
/* Constants of a rectangular cantilever with the laser at its end. The first mode has 0.971 of the
 * thermal energy. The slope of the free end is 1.09 times that of a loaded end at equal deflection.
 * Together the factor is 0.817 (Butt and Jaschke 1995). */
static const double first_mode = 0.971, free_over_pressed = 1.09;
/* Significance level of the misfit below which no interval is reported. This is a heuristic: one
 * good spectrum in a thousand has such a misfit. */
static const double misfit_p_threshold = 1e-3;
/* Largest ratio of the stated averages to those from the scatter. This is a heuristic: windows
 * share bins, and instruments count averages differently. */
static const double max_averages_ratio = 2;
/* Smallest number of spectra for an interval from their scatter. The interval of two spectra, with
 * one degree of freedom, is 13 standard errors wide. */
enum { MIN_SPECTRA = 3 };
/* Factor beyond which two spring constants of one cantilever are inconsistent. This is a heuristic:
 * thermal noise, Sader's method and the plan view are each accurate to 10 to 20 %. The factor is at
 * least two standard deviations of their ratio. */
static const double inconsistency = 1.5;
/* Range of length over width in which Sader, Chon and Mulvaney tested their formula. */
static const double min_slenderness = 3.3, max_slenderness = 13.7;

wt_thermal_job wt_thermal_job_defaults(void)
{
    const double unknown = (double)NAN;
    return (wt_thermal_job){.temperature = {unknown, 0, 0, "K"},
                            .mode_shape = first_mode,
                            .chi = free_over_pressed,
                            .from = unknown,
                            .to = unknown,
                            .length = {unknown, 0, 0, "m"},
                            .width = {unknown, 0, 0, "m"},
                            .sader_coefficient = {unknown, 0, 0, "1"}};
}

static const wt_param rows[] = {
    {PARAM("lever-temperature", wt_thermal_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "that of the file, else 25degC with a warning", .flags = PARAM_NO_CASE,
     .help = "temperature of the cantilever, such as \"23degC +- 1K\""},
    {PARAM("sensitivity-error", wt_thermal_job, sensitivity_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X", .flags = PARAM_NO_CASE,
     .help = "relative standard error of the deflection sensitivity, such as 0.02"},
    {PARAM("mode-shape", wt_thermal_job, mode_shape, WT_Q_NONE, ABOVE(0)), .value = "X",
     .flags = PARAM_NO_CASE,
     .help = "share of the first mode in the thermal energy of the cantilever's end: 0.971 of a "
             "rectangular cantilever, 1 to leave it out"},
    {PARAM("chi", wt_thermal_job, chi, WT_Q_NONE, ABOVE(0)), .value = "X", .flags = PARAM_NO_CASE,
     .help =
         "deflection sensitivity of the free cantilever over that on a hard surface: 1.09 of a "
         "rectangular cantilever with the laser at its end; 1 if it is in the spectrum already"},
    {PARAM("fit-from", wt_thermal_job, from, WT_Q_FREQUENCY, AT_LEAST(0)), .value = "F",
     .unset = "40 widths of the peak below it, at least a quarter of its frequency",
     .flags = PARAM_NO_CASE, .help = "beginning of the range of the fit, such as 50kHz"},
    {PARAM("fit-to", wt_thermal_job, to, WT_Q_FREQUENCY, ABOVE(0)), .value = "F",
     .unset = "40 widths above it, at most three times its frequency", .flags = PARAM_NO_CASE,
     .help = "end of the range of the fit"},
    {PARAM("length", wt_thermal_job, length, WT_Q_LENGTH, ABOVE(0)), .value = "L", .unset = "",
     .flags = PARAM_NO_CASE,
     .help = "length of a rectangular cantilever, such as \"225um +- 2%\": with --width its spring "
             "constant by Sader's method stands beside that of the noise"},
    {PARAM("width", wt_thermal_job, width, WT_Q_LENGTH, ABOVE(0)), .value = "B", .unset = "",
     .flags = PARAM_NO_CASE, .help = "width of a rectangular cantilever, such as 40um"},
    {PARAM_CHOICE_OF("medium", wt_thermal_job, medium, "air|water"), .flags = PARAM_NO_CASE,
     .help = "what surrounds the cantilever, at its temperature and 1013 hPa; for --length and "
             "--width"},
    {PARAM("sader-coefficient", wt_thermal_job, sader_coefficient, WT_Q_NONE, ABOVE(0)),
     .value = "A", .unset = "", .flags = PARAM_NO_CASE,
     .help =
         "coefficient of a kind of cantilever of any shape, k = A Q f^1.3 with k in N/m and f in "
         "kHz, as of one that was calibrated; instead of --length and --width"},
};
PARAM_TABLE(wt_thermal_job_params, wt_thermal_job, rows, wt_thermal_job_defaults, NO_PARTS)

/* ---- one spectrum ---------------------------------------------------------------------------- */

typedef struct cantilever_result {
    wt_noise_spectrum spectrum;
    wt_thermal fit;
    wt_estimate temperature;
    double sensitivity;             /* 1 for a spectrum in metres */
    double constant, common, error; /* relative errors: systematic, and of this spectrum */
    wt_estimate sader;              /* by Sader's method; NaN if not requested */
    char inconsistency[512];        /* inconsistency with another spring constant; "" if none */
    char note[768];
} cantilever_result;

static void append_cantilever_note(cantilever_result *l, const char *note)
{
    const size_t used = strlen(l->note);
    snprintf(l->note + used, sizeof l->note - used, "%s%s", used > 0 ? "; " : "", note);
}

static wt_status find_sensitivity(const wt_job *work, cantilever_result *l, const flow_file *file,
                                  wt_error *err)
{
    const double given_sensitivity = file->set->read.sensitivity,
                 file_sensitivity = l->spectrum.sensitivity;
    if (!l->spectrum.volts) {
        l->sensitivity = given_sensitivity > 0 && file_sensitivity > 0
                             ? given_sensitivity / file_sensitivity
                             : 1;
        if (given_sensitivity > 0 && !(file_sensitivity > 0))
            wt_log_add(work->log, WT_WARNING, file->name, NULL,
                       "the spectrum is in metres and the file does not say by which "
                       "sensitivity: that of --sensitivity is not used");
        return WT_OK;
    }
    l->sensitivity = !isnan(given_sensitivity) ? given_sensitivity : file_sensitivity;
    if (l->sensitivity > 0)
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_MISSING, "the spectrum is in volts");
    wt_error_expected(err, "a deflection sensitivity");
    wt_error_advice(err, "give it, e.g. --sensitivity 60nm/V");
    wt_error_options(err, "sensitivity");
    return status;
}

static void find_cantilever_temperature(const wt_thermal_job *job, const wt_job *work,
                                        const flow_file *file, cantilever_result *l)
{
    l->temperature = job->temperature;
    if (!isnan(l->temperature.value))
        return;
    l->temperature = (wt_estimate){l->spectrum.temperature, 0, 0, "K"};
    if (l->temperature.value > 0)
        return;
    l->temperature.value = room_temperature;
    wt_log_add(work->log, WT_WARNING, file->name, NULL,
               "the file %s: 25 degC is taken, and 3 K off are 1 %% of the spring constant; "
               "give --lever-temperature",
               isnan(l->spectrum.temperature) ? "does not say the temperature of the cantilever"
                                              : "says a temperature below absolute zero");
}

/* Reports excluded points. The point at 0 Hz is no noise and its exclusion is normal; a missing or
 * zero density may be an error. */
static void report_excluded_points(const wt_job *work, const flow_file *file, cantilever_result *l)
{
    const wt_noise_spectrum *s = &l->spectrum;
    size_t n = 0, first = 0;
    char text[160];
    for (size_t i = 0; i < s->n; i++)
        if (s->frequency[i] > 0 && !(s->density[i] > 0 && isfinite(s->density[i])))
            first = n++ == 0 ? i : first;
    if (s->n > 0 && s->frequency[0] == 0)
        append_cantilever_note(l, "the point at 0 Hz is left out");
    if (n == 0)
        return;
    snprintf(text, sizeof text, "%zu of %zu points without a density above 0 left out", n, s->n);
    append_cantilever_note(l, text);
    wt_log_add(work->log, WT_WARNING, file->name, NULL, "%s, the first at %g Hz", text,
               s->frequency[first]);
}

static void report_spectrum_misfit(const wt_job *work, const flow_file *file, cantilever_result *l)
{
    const double stated_averages = l->spectrum.averages;
    if (!l->fit.found) {
        append_cantilever_note(l, l->fit.reason);
        return;
    }
    if (l->fit.misfit_p < misfit_p_threshold) {
        append_cantilever_note(
            l, "the spectrum departs from an oscillator on a white floor: no interval");
        wt_log_add(work->log, WT_WARNING, file->name, NULL,
                   "the spectrum departs from an oscillator on a white floor more than its "
                   "scatter explains; another range of the fit (--fit-from, --fit-to) may "
                   "help; no interval is reported");
    }
    if (stated_averages > max_averages_ratio * l->fit.averages)
        append_cantilever_note(l, "scatters more than so many averages do");
    if (l->spectrum.amplitudes)
        append_cantilever_note(l, "amplitudes are treated as roots of averaged power");
}

static void find_spring_constant(const wt_thermal_job *job, cantilever_result *l)
{
    const double square = l->sensitivity * l->sensitivity * l->fit.mean_square.value;
    const double has_temperature_error = l->temperature.standard_error > 0
                                             ? l->temperature.standard_error / l->temperature.value
                                             : 0;
    l->constant =
        job->mode_shape / (job->chi * job->chi) * boltzmann * l->temperature.value / square;
    l->error = l->fit.mean_square.standard_error / l->fit.mean_square.value;
    l->common = hypot(has_temperature_error, 2 * job->sensitivity_error);
}

/* ---- comparison: Sader's method, the file ---------------------------------------------------- */

static wt_estimate estimate_from_interval(wt_interval i, const char *unit)
{
    return (wt_estimate){i.value, i.standard_error, 0, unit};
}

/* Computes the spring constant by Sader's method from resonance and quality factor of the fit. */
static void find_sader_constant(const wt_thermal_job *job, cantilever_result *l)
{
    const wt_estimate f = estimate_from_interval(l->fit.resonance, "Hz"),
                      q = estimate_from_interval(l->fit.quality, "1"), a = job->sader_coefficient;
    const double slenderness = job->length.value / job->width.value;
    if (!isnan(a.value)) {
        const double k = a.value * q.value * pow(1e-3 * f.value, 1.3);
        l->sader = (wt_estimate){
            k,
            k * hypot(a.standard_error / a.value,
                      hypot(q.standard_error / q.value, 1.3 * f.standard_error / f.value)),
            0, "N/m"};
        return;
    }
    if (isnan(slenderness))
        return;
    l->sader = wt_sader_spring_constant(job->length, job->width, f, q,
                                        wt_medium_properties(job->medium, l->temperature.value));
    if (isnan(l->sader.value))
        append_cantilever_note(
            l, "no spring constant by Sader's method: water is not liquid at this temperature");
    if (slenderness < min_slenderness || slenderness > max_slenderness)
        append_cantilever_note(
            l, "Sader's method was tried on cantilevers 3.3 to 13.7 times as long as wide");
}

/* Describes possible causes if the spring constant from noise is `ratio` times another one. */
static void describe_inconsistency(cantilever_result *l, const char *other, double ratio)
{
    const bool small = ratio < 1;
    if (!(fmax(ratio, 1 / ratio) > inconsistency) || l->inconsistency[0] != '\0')
        return;
    clocale_print(l->inconsistency, sizeof l->inconsistency,
                  "the noise gives %.3g times the spring constant %s; what could be the cause: a "
                  "deflection sensitivity %.3g times too %s, %s, or the other one (nominal, or of "
                  "a plan view or quality factor that is not this cantilever's)",
                  ratio, other, small ? sqrt(1 / ratio) : sqrt(ratio), small ? "large" : "small",
                  small
                      ? "densities of peak values (a factor 2) or with the width of a window in "
                        "them (1.5 of Hann's)"
                      : "two-sided densities (a factor 2) or a peak that is not the cantilever's");
}

static void compare_spring_constants(const wt_job *work, const flow_file *file,
                                     cantilever_result *l)
{
    describe_inconsistency(l, "by Sader's method", l->constant / l->sader.value);
    describe_inconsistency(l, "of the file", l->constant / l->spectrum.spring_constant);
    if (l->inconsistency[0] == '\0')
        return;
    append_cantilever_note(l, l->inconsistency);
    wt_log_add(work->log, WT_WARNING, file->name, NULL, "%s; none is advised", l->inconsistency);
}

static wt_status measure_cantilever(const wt_thermal_job *job, const wt_job *work, flow_file *file,
                                    cantilever_result *l, wt_error *err)
{
    wt_input *input = NULL;
    wt_status status = flow_open(work, file, "thermal", WT_KIND_NOISE, &input, err);
    const wt_read_options read = flow_read_options(file);
    if (status == WT_OK)
        status = wt_noise_read(work->formats, input, &read, work->log, &l->spectrum, err);
    if (status == WT_OK)
        status = flow_check_copy(
            file,
            flow_hash_samples(flow_hash_samples(0, l->spectrum.frequency, l->spectrum.n),
                              l->spectrum.density, l->spectrum.n),
            work);
    if (status == WT_OK)
        status = find_sensitivity(work, l, file, err);
    if (status == WT_OK)
        status = wt_thermal_fit(l->spectrum.frequency, l->spectrum.density, l->spectrum.n,
                                job->from, job->to, &l->fit, err);
    wt_input_close(input);
    if (status != WT_OK)
        return status;
    find_cantilever_temperature(job, work, file, l);
    report_excluded_points(work, file, l);
    report_spectrum_misfit(work, file, l);
    l->sader.value = l->sader.standard_error = (double)NAN;
    if (!l->fit.found)
        return WT_OK;
    find_spring_constant(job, l);
    find_sader_constant(job, l);
    compare_spring_constants(work, file, l);
    return WT_OK;
}

/* ---- the table ------------------------------------------------------------------------------- */

static bool has_interval(const cantilever_result *l)
{
    return l->fit.found && !(l->fit.misfit_p < misfit_p_threshold);
}

/* Sets a number, its error and the limits of its interval. Their columns must be consecutive. */
static void set_interval_columns(table_writer *t, thermal_column first, wt_interval i,
                                 bool has_errors)
{
    thermal_put(t, first, i.value);
    if (!has_errors)
        return;
    thermal_put(t, first + 1, i.standard_error);
    thermal_put(t, first + 2, i.low);
    thermal_put(t, first + 3, i.high);
}

static void add_cantilever_row(table_writer *t, const flow_file *file, const cantilever_result *l)
{
    const wt_thermal *f = &l->fit;
    const bool has_errors = has_interval(l);
    table_row(t);
    thermal_put_text(t, THERMAL_FILE, file->name);
    thermal_put_text(t, THERMAL_NOTE, l->note);
    thermal_put(t, THERMAL_TEMPERATURE, l->temperature.value);
    thermal_put(t, THERMAL_POINTS, (double)f->n);
    thermal_put(t, THERMAL_OF_FILE, l->spectrum.spring_constant);
    thermal_put(t, THERMAL_AVERAGES_OF_FILE, l->spectrum.averages);
    thermal_put(t, THERMAL_FROM, f->from);
    thermal_put(t, THERMAL_TO, f->to);
    if (!f->found)
        return;
    const double error = hypot(l->error, l->common), half = NORMAL_95 * error;
    set_interval_columns(t, THERMAL_SPRING_CONSTANT,
                         (wt_interval){l->constant, l->constant * error, l->constant * exp(-half),
                                       l->constant * exp(half)},
                         has_errors);
    set_interval_columns(t, THERMAL_RESONANCE, f->resonance, has_errors);
    set_interval_columns(t, THERMAL_QUALITY, f->quality, has_errors);
    if (has_errors)
        thermal_put(t, THERMAL_FIT_ERROR, l->error);
    thermal_put(t, THERMAL_DEFLECTION, l->sensitivity * sqrt(f->mean_square.value));
    thermal_put(t, THERMAL_FLOOR, l->sensitivity * sqrt(f->floor));
    thermal_put(t, THERMAL_RATIO, l->constant / l->spectrum.spring_constant);
    thermal_put(t, THERMAL_SADER, l->sader.value);
    if (has_errors)
        thermal_put(t, THERMAL_SADER_STANDARD_ERROR, l->sader.standard_error);
    thermal_put(t, THERMAL_SADER_RATIO, l->constant / l->sader.value);
    thermal_put(t, THERMAL_AVERAGES, f->averages);
    thermal_put(t, THERMAL_CHANCE, f->misfit_p);
}

/* Mean spring constant of all spectra. Its error is that of the spectrum, or from three spectra on
 * the scatter between them. */
static wt_estimate mean_spring_constant(const cantilever_result *cantilevers, size_t n,
                                        double *scatter)
{
    wt_estimate k = {(double)NAN, (double)NAN, 0, "N/m"};
    double sum = 0, file_sensitivity = 0, squares = 0, common = 0, found = 0;
    bool has_errors = true; /* a departure from the oscillator may be systematic */
    *scatter = (double)NAN;
    for (size_t i = 0; i < n; i++)
        if (cantilevers[i].fit.found) {
            sum += cantilevers[i].constant;
            file_sensitivity += cantilevers[i].error * cantilevers[i].error;
            common = cantilevers[i].common;
            has_errors = has_errors && has_interval(&cantilevers[i]);
            found++;
        }
    if (!(found > 0))
        return k;
    k.value = sum / found;
    for (size_t i = 0; i < n; i++)
        if (cantilevers[i].fit.found)
            squares += pow(cantilevers[i].constant / k.value - 1, 2);
    if (found >= MIN_SPECTRA)
        *scatter = sqrt(squares / (found - 1));
    const double mean_error =
        (found >= MIN_SPECTRA ? *scatter : sqrt(file_sensitivity / found)) / sqrt(found);
    if (has_errors)
        k.standard_error = k.value * hypot(mean_error, common);
    return k;
}

static void set_thermal_keys(table_writer *t, const wt_thermal_job *job,
                             const cantilever_result *cantilevers, size_t n)
{
    double scatter;
    const wt_estimate k = mean_spring_constant(cantilevers, n, &scatter);
    const bool has_temperature_error = n > 0 && cantilevers[0].temperature.standard_error > 0;
    thermal_set_print(t, THERMAL_KEY_MODE_SHAPE, "%g", job->mode_shape);
    thermal_set_print(t, THERMAL_KEY_CHI, "%g", job->chi);
    thermal_set_print(t, THERMAL_KEY_N_SPECTRA, "%zu", n);
    thermal_set_print(t, THERMAL_KEY_INCLUDES, "%s%s%s",
                      isnan(scatter) ? "the fit" : "the scatter between spectra",
                      job->sensitivity_error > 0 ? " and the sensitivity" : "",
                      has_temperature_error ? " and the temperature" : "");
    if (isnan(k.value))
        return;
    thermal_set(t, THERMAL_KEY_SPRING_CONSTANT, k);
    if (!isnan(scatter))
        thermal_set_print(t, THERMAL_KEY_SCATTER, "%.3g", scatter);
    for (size_t i = 0; i < n; i++)
        if (cantilevers[i].inconsistency[0] != '\0') {
            thermal_set_text(t, THERMAL_KEY_CONTRADICTION, cantilevers[i].inconsistency);
            return;
        }
    thermal_set_print(t, THERMAL_KEY_INDENT, "--spring-constant %.6gN/m", k.value);
    if (k.standard_error > 0)
        thermal_set_print(t, THERMAL_KEY_COMPARE, "--spring-constant-error %.2g",
                          k.standard_error / k.value);
}

static wt_status tabulate_thermal(const wt_thermal_job *job, const wt_job *work,
                                  const flow_files *files, wt_table **table, wt_error *err)
{
    wt_status status = WT_OK;
    size_t n = 0, n_failed = 0;
    cantilever_result *cantilevers = wt_alloc(files->n + 1, sizeof *cantilevers);
    table_writer t = table_begin(&thermal_schema, err);
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        cantilever_result l = {.note = ""};
        status = measure_cantilever(job, work, &files->file[i], &l, &failure);
        if (status == WT_OK) {
            add_cantilever_row(&t, &files->file[i], &l);
            cantilevers[n++] = l;
        } else if (flow_skip_file(work, &files->file[i], &failure)) {
            status = WT_OK;
        } else {
            n_failed++;
            status = wt_job_add_failure(work, files->file[i].name, status, &failure, err);
        }
        wt_noise_spectrum_clear(&l.spectrum);
    }
    if (status == WT_OK && n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no spectrum of thermal noise could be read");
        flow_error_add_files(files, n_failed, err);
    }
    set_thermal_keys(&t, job, cantilevers, n);
    free(cantilevers);
    cost_report(work, (cost_summary){.items = (double)n});
    const wt_status written = table_end(&t, table);
    if (status != WT_OK && written == WT_OK) {
        wt_table_free(*table);
        *table = NULL;
    }
    return status != WT_OK ? status : written;
}

wt_status wt_thermal_compute(const wt_thermal_job *job, const wt_job *work, wt_table **table,
                             wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no job of thermal noise");
    flow_files files = {0};
    wt_status status = param_check(wt_thermal_job_params(), job, err);
    if (status == WT_OK && isnan(job->length.value) != isnan(job->width.value)) {
        status =
            wt_fail(err, WT_E_ARG, "%s without %s", isnan(job->width.value) ? "length" : "width",
                    isnan(job->width.value) ? "width" : "length");
        wt_error_advice(err, "Sader's method takes both: --length 225um --width 40um");
    }
    if (status == WT_OK && !isnan(job->length.value) && !isnan(job->sader_coefficient.value)) {
        status = wt_fail(err, WT_E_ARG, "length and width beside a coefficient of Sader's method");
        wt_error_advice(err, "give --length and --width, or --sader-coefficient");
    }
    if (status == WT_OK && !(isnan(job->from) || isnan(job->to) || job->from < job->to))
        status = range_error("fit-to", job->to, "more than fit-from", err);
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK)
        status = tabulate_thermal(job, work, &files, table, err);
    flow_files_clear(&files);
    return status;
}
