/* The job of measured surfaces: converts height maps and profiles to one power spectrum, and writes
 * their tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/surface.h"

#include "core/base/number.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "surface/numerics/surface_analysis.h"
#include "weartrack/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- heights, thinned for a figure ----------------------------------------------------------- */

/* Maximum points along the side of all maps of a figure, and along a line: more than a page
 * resolves. */
enum { MOST_SIDE = 256, MOST_LINE = 2048 };

static void surface_view_clear(surface_view *view)
{
    free(view->z);
    free(view->line);
    *view = (surface_view){.nx = 0};
}

/* Returns the step that leaves at most `most` of n points. */
static size_t thinning_step(size_t n, size_t most)
{
    return (n - 1) / most + 1;
}

static size_t thinned_count(size_t n, size_t step)
{
    return (n - 1) / step + 1;
}

static surface_view thin_heights(const wt_height_map *map, size_t most)
{
    const bool profile = map->ny == 1;
    const size_t step = thinning_step(map->nx > map->ny ? map->nx : map->ny, most),
                 along = thinning_step(map->nx, MOST_LINE);
    const double *const row = map->z + map->ny / 2 * map->nx;
    surface_view view = {.nx = profile ? 0 : thinned_count(map->nx, step),
                         .ny = profile ? 0 : thinned_count(map->ny, step),
                         .dx = map->dx * (double)step,
                         .dy = map->dy * (double)step,
                         .n_line = thinned_count(map->nx, along),
                         .line_step = map->dx * (double)along};
    view.z = wt_alloc(view.nx * view.ny, sizeof *view.z);
    view.line = wt_alloc(view.n_line, sizeof *view.line);
    for (size_t j = 0; j < view.ny; j++)
        for (size_t i = 0; i < view.nx; i++)
            view.z[j * view.nx + i] = map->z[j * step * map->nx + i * step];
    for (size_t i = 0; i < view.n_line; i++)
        view.line[i] = row[i * along];
    return view;
}

/* Thins the heights so that the maps of n_scans scans fit into one figure. The caller clears
 * `to`. */
static wt_status surface_view_create(const wt_height_map *map, wt_surface_form form, size_t n_scans,
                                     surface_view *to, wt_error *err)
{
    const size_t maps_per_row = (size_t)ceil(sqrt((double)n_scans));
    double coefficients[FORM_TERMS];
    double *z = wt_alloc(map->nx * map->ny, sizeof *z);
    memcpy(z, map->z, map->nx * map->ny * sizeof *z);
    const wt_height_map less = {z, map->nx, map->ny, map->dx, map->dy, map->levelled};
    const wt_status status =
        surface_remove_form(z, map->nx, map->ny, (unsigned)form, coefficients, err);
    if (status == WT_OK)
        *to = thin_heights(&less, maps_per_row < MOST_SIDE ? MOST_SIDE / maps_per_row : 1);
    free(z);
    return status;
}

TABLE_ROW(height_map, HEIGHT_MAP, double scan, x, y, height;)

TABLE_ROW(height_profile, HEIGHT_PROFILE, double scan, x, height;)

static wt_status build_map_table(const surface_scan *scans, size_t n, wt_table **table,
                                 wt_error *err)
{
    table_writer t = table_begin(&height_map_schema, err);
    for (size_t s = 0; s < n; s++) {
        const surface_view *v = &scans[s].view;
        for (size_t j = 0; j < v->ny; j++)
            for (size_t i = 0; i < v->nx; i++)
                TABLE_ADD(height_map, &t, (double)(s + 1), (double)i * v->dx, (double)j * v->dy,
                          v->z[j * v->nx + i]);
    }
    return table_end(&t, table);
}

static wt_status build_profile_table(const surface_scan *scans, size_t n, wt_table **table,
                                     wt_error *err)
{
    table_writer t = table_begin(&height_profile_schema, err);
    for (size_t s = 0; s < n; s++) {
        const surface_view *v = &scans[s].view;
        for (size_t i = 0; i < v->n_line; i++)
            TABLE_ADD(height_profile, &t, (double)(s + 1), (double)i * v->line_step, v->line[i]);
    }
    return table_end(&t, table);
}

/* Significance level of an anisotropy. */
static const double misfit_p_threshold = 0.01;

/* Returns true if the anisotropy is significant. */
static bool surface_is_anisotropic(const wt_surface_anisotropy *directions)
{
    return directions->p_value < misfit_p_threshold;
}

TABLE_ROW(power_spectrum, POWER_SPECTRUM, double wavenumber; wt_interval density;
          double modes_error, modes_tie, law_error, self_affine, modes, scans; const char *source;)
TABLE_ROW(place_errors, PLACE_ERRORS, size_t size, row; double wavenumber, error;)
TABLE_KEYS(power_spectrum, POWER_SPECTRUM, wt_estimate rms_height, rms_slope, hurst, hurst_low,
           hurst_high, c0, roll_off, roll_off_low, roll_off_high;
           const char *law; wt_estimate reliable_from, reliable_to; const char *ends_by;
           wt_estimate steep; const char *steep_by;
           wt_estimate extrapolated_share, place_scatter, place_error, anisotropy,
           anisotropy_direction, anisotropy_fourth, anisotropy_fourth_direction;
           const char *directions, *profiles, *includes, *lacks, *option, *convention;
           size_t n_scans;)
TABLE_ROW(angular_spectrum, ANGULAR_SPECTRUM, double direction; wt_interval ratio;
          double terms, modes;)
TABLE_KEYS(angular_spectrum, ANGULAR_SPECTRUM, double chance, p_value_fourth;)
TABLE_ROW_OF(surfaces, SURFACES, surface_scan)
TABLE_KEYS(surfaces, SURFACES, const char *form, *window;)

static wt_estimate plain_estimate(double value, double standard_error)
{
    return (wt_estimate){value, standard_error, 0, NULL};
}

static wt_estimate interval_estimate(wt_interval i, bool known)
{
    return known ? plain_estimate(i.value, i.standard_error) : plain_estimate((double)NAN, 0);
}

/* ---- power spectrum -------------------------------------------------------------------------- */

static wt_interval law_interval(const wt_self_affine *law, double q)
{
    const double c = wt_self_affine_density(law, q), error = wt_self_affine_log_error(law, q, true);
    return (wt_interval){c, c * error, c * exp(-NORMAL_95 * error), c * exp(NORMAL_95 * error)};
}

static void add_spectrum_rows(table_writer *t, const surface_result *w)
{
    const double nan = (double)NAN;
    const surface_knots *k = &w->knots;
    for (size_t i = 0; i < k->n; i++) {
        const bool law = i >= k->n_measured, cut = k->cut && i + 1 == k->n_measured,
                   bin = !law && !cut;
        const double c = k->density[i], q = k->wavenumber[i];
        const wt_interval none = {c, nan, nan, nan};
        TABLE_ADD(power_spectrum, t, q,
                  bin   ? wt_surface_density(&w->spectrum, i)
                  : law ? law_interval(&w->law, q)
                        : none,
                  bin ? sqrt(surface_log_variance(w->spectrum.bins[i].freedom)) : nan,
                  bin && i + 1 < w->spectrum.n ? surface_next_bin_correlation(&w->spectrum, i)
                                               : nan,
                  law ? surface_law_error(w, q) : nan, wt_self_affine_density(&w->law, q),
                  bin ? (double)w->spectrum.bins[i].n : nan,
                  bin ? (double)w->spectrum.bins[i].scans : nan,
                  bin   ? "measured"
                  : cut ? "cut"
                        : "law");
    }
}

static void print_law(const surface_result *w, char *to, size_t size)
{
    const wt_self_affine *l = &w->law;
    if (!l->found)
        clocale_print(to, size, "none: %s",
                      l->n > 0 ? "the spectrum does not fall" : "too few wavenumbers are reliable");
    else
        clocale_print(
            to, size, "%s; misfit %.2g (chi-squared over degrees of freedom, of %zu bins%s)",
            l->rolls_off ? "with a roll-off"
                         : "no roll-off in the reliable range: the surface has longer waves",
            l->misfit, l->n,
            l->misfit > SELF_AFFINE_BAD ? ": the law describes the spectrum badly" : "");
}

static void print_directions(const surface_result *w, char *to, size_t size)
{
    const wt_surface_anisotropy *a = &w->directions;
    if (isnan(a->amplitude))
        clocale_print(to, size, "inconclusive: profiles show no directions; a height map would");
    else if (surface_is_anisotropic(a))
        clocale_print(to, size,
                      "differ: C changes by %.2g of its mean, most at %.0f deg from x (chance of "
                      "as much by scatter: %.1g)",
                      a->amplitude, a->direction * 180 / M_PI, a->p_value);
    else
        clocale_print(to, size,
                      "alike: C changes by %.2g of its mean, as scatter does (chance %.2g)",
                      a->amplitude, a->p_value);
}

/* Formats the option that gives the law to friction, from the first bin to the end of the
 * spectrum. */
static void print_roughness_option(const surface_result *w, char *to, size_t size)
{
    const surface_knots *k = &w->knots;
    to[0] = '\0';
    if (w->law.found)
        clocale_print(to, size,
                      "--roughness self-affine:q0=%.6grad/m,qr=%.6grad/m,q1=%.6grad/m,hurst=%.4g,"
                      "c0=%.6gm^4",
                      k->wavenumber[0], w->law.roll_off.value, k->wavenumber[k->n - 1],
                      w->law.hurst.value, w->law.c0.value);
}

static wt_status build_angular_table(const surface_result *w, wt_table **table, wt_error *err)
{
    const wt_surface_anisotropy *two = &w->directions, *four = &w->fourth;
    table_writer t = table_begin(&angular_spectrum_schema, err);
    for (size_t i = 1; i <= WT_SURFACE_SECTORS; i++) {
        /* The directions range from -pi/2 (exclusive) to pi/2; half a turn gives the same
         * direction. */
        const size_t sector = (i + WT_SURFACE_SECTORS / 2) % WT_SURFACE_SECTORS;
        const double phi = ((double)i / WT_SURFACE_SECTORS - 0.5) * M_PI;
        double modes = 0;
        const wt_interval ratio =
            wt_surface_sector(surface_directional_spectrum(w), sector, &modes);
        TABLE_ADD(angular_spectrum, &t, phi, ratio,
                  1 + two->amplitude * cos(2 * (phi - two->direction)) +
                      four->amplitude * cos(4 * (phi - four->direction)),
                  modes);
    }
    TABLE_SET(angular_spectrum, &t, two->p_value, four->p_value);
    return table_end(&t, table);
}

static const char *density_error_sources(const surface_result *w, bool places)
{
    if (w->knots.n > w->knots.n_measured)
        return places
                   ? "modes of each bin, constants of the law beyond, scatter from place to place"
                   : "modes of each bin, constants of the law beyond";
    return places ? "modes of each bin, scatter from place to place" : "modes of each bin";
}

static wt_status build_spectrum_table(const surface_result *w, size_t n_scans, wt_table **table,
                                      wt_error *err)
{
    char law[256], directions[256], profiles[400], option[256];
    const wt_surface_spectrum *s = &w->spectrum;
    const bool places = !isnan(s->place_scatter), rolls_off = w->law.rolls_off && w->law.found;
    const double nan = (double)NAN;
    table_writer t = table_begin(&power_spectrum_schema, err);
    add_spectrum_rows(&t, w);
    print_law(w, law, sizeof law);
    print_directions(w, directions, sizeof directions);
    surface_describe_profiles(w, profiles, sizeof profiles);
    print_roughness_option(w, option, sizeof option);
    TABLE_SET(power_spectrum, &t, .rms_height = w->rms_height, .rms_slope = w->rms_slope,
              .hurst = interval_estimate(w->law.hurst, w->law.found),
              .hurst_low = plain_estimate(w->law.found ? w->law.hurst.low : nan, 0),
              .hurst_high = plain_estimate(w->law.found ? w->law.hurst.high : nan, 0),
              .c0 = interval_estimate(w->law.c0, w->law.found),
              .roll_off = interval_estimate(w->law.roll_off, rolls_off),
              .roll_off_low = plain_estimate(rolls_off ? w->law.roll_off.low : nan, 0),
              .roll_off_high = plain_estimate(rolls_off ? w->law.roll_off.high : nan, 0),
              .law = law, .reliable_from = plain_estimate(s->bins[0].wavenumber, 0),
              .reliable_to = plain_estimate(s->bins[s->n - 1].wavenumber, 0), .ends_by = s->ends_by,
              .steep = plain_estimate(w->steep, 0),
              .steep_by = isnan(w->steep)   ? "not reached"
                          : w->steep_by_law ? "law"
                                            : "measured",
              .extrapolated_share =
                  plain_estimate(w->knots.n > w->knots.n_measured ? w->extrapolated_share : nan, 0),
              .place_scatter = plain_estimate(s->place_scatter, 0),
              .place_error = plain_estimate(s->place_error, 0),
              .anisotropy = plain_estimate(w->directions.amplitude, w->directions.amplitude_error),
              .anisotropy_direction =
                  plain_estimate(w->directions.direction, w->directions.direction_error),
              .anisotropy_fourth = plain_estimate(w->fourth.amplitude, w->fourth.amplitude_error),
              .anisotropy_fourth_direction =
                  plain_estimate(w->fourth.direction, w->fourth.direction_error),
              .directions = directions, .profiles = profiles,
              .includes = density_error_sources(w, places),
              .lacks = places ? "calibration of the scanner, noise of the instrument"
                              : "places of the surface, calibration of the scanner, noise of the "
                                "instrument",
              .option = option,
              .convention = "h_rms^2 = 2 pi int q C dq; of contact.engineering: (2 pi)^2 C",
              .n_scans = n_scans);
    return table_end(&t, table);
}

/* ---- place errors by scan size --------------------------------------------------------------- */

static wt_status build_position_error_table(const surface_result *w, wt_table **table,
                                            wt_error *err)
{
    table_writer t = table_begin(&place_errors_schema, err);
    for (size_t size = 0; size < w->spectrum.n_sizes; size++)
        for (size_t i = 0; i < w->knots.n; i++) {
            const double error = surface_knot_size_error(&w->spectrum, i, size);
            if (error > 0)
                TABLE_ADD(place_errors, &t, size + 1, i + 1, w->knots.wavenumber[i], error);
        }
    return table_end(&t, table);
}

/* ---- scans ----------------------------------------------------------------------------------- */

static wt_status build_surface_table(const wt_params *params, const wt_topography_job *job,
                                     const surface_scan *scans, size_t n, wt_table **table,
                                     wt_error *err)
{
    char form[PARAM_CHOICE_NAME_SIZE], window[PARAM_CHOICE_NAME_SIZE];
    param_choice_name(params, "form", job->options.form, form, sizeof form);
    param_choice_name(params, "window", job->options.window, window, sizeof window);
    table_writer t = table_begin(&surfaces_schema, err);
    for (size_t i = 0; i < n; i++)
        surfaces_add_row(&t, &scans[i]);
    TABLE_SET(surfaces, &t, form, window);
    return table_end(&t, table);
}

/* Builds the tables. params: parameters of the job, for the texts of its choices. The caller
 * clears `tables`. */
static wt_status surface_tables_make(const wt_params *params, const wt_topography_job *job,
                                     const surface_scan *scans, size_t n,
                                     const surface_result *whole, wt_topography_tables *tables,
                                     wt_error *err)
{
    wt_topography_tables made = {.power_spectrum = NULL};
    bool maps = false;
    for (size_t i = 0; i < n; i++)
        maps = maps || scans[i].map.ny > 1;
    wt_status status = build_spectrum_table(whole, n, &made.power_spectrum, err);
    if (status == WT_OK && surface_knot_position_error(&whole->spectrum, 0) > 0)
        status = build_position_error_table(whole, &made.place_errors, err);
    if (status == WT_OK && !isnan(whole->directions.amplitude))
        status = build_angular_table(whole, &made.angular_spectrum, err);
    if (status == WT_OK)
        status = build_surface_table(params, job, scans, n, &made.surfaces, err);
    if (status == WT_OK && job->heights)
        status = build_profile_table(scans, n, &made.height_profile, err);
    if (status == WT_OK && job->heights && maps)
        status = build_map_table(scans, n, &made.height_map, err);
    if (status == WT_OK)
        *tables = made;
    else
        wt_tables_clear(&made, sizeof made);
    return status;
}

/* Smallest amplitude of an anisotropy that causes a warning. Friction changes by a third to a half
 * of it: the mean of cos 2 phi with the weight cos(phi)^(1 + n), where n = 0 to 1 is the slope of
 * ln E''. Here that is 3 to 5 %. */
static const double least_anisotropy = 0.1;
/* Share of filled heights that causes a warning. They have no short waves, so C of short waves is
 * too low by about this share, half of what aliased waves add at the end of the range. */
static const double missing_share_limit = 0.01;

wt_topography_job wt_topography_job_defaults(void)
{
    return (wt_topography_job){
        .options = wt_surface_options_defaults(), .end = (double)NAN, .end_slope = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("form", wt_topography_job, options.form, "mean|plane|quadratic"),
     .help = "form of a scan that is taken off by least squares; of a profile the same of one "
             "variable"},
    {PARAM_CHOICE_OF("window", wt_topography_job, options.window, "hann|welch|none"),
     .help = "window before the transform; none is for surfaces that go on beyond their edges"},
    {PARAM_CHOICE_OF("scan-lines", wt_topography_job, scan_lines, "mend|keep"),
     .help = "what happens to offsets of scan lines and to scars: mend removes them, keep only "
             "names them"},
    {PARAM("tip-radius", wt_topography_job, options.tip_radius, WT_Q_LENGTH, ABOVE(0)),
     .value = "R", .unset = "",
     .help =
         SUCH_AS("radius of the tip that scanned, ", "10nm",
                 ": the reliable range ends where peaks are as sharp as half of its curvature")},
    {PARAM_TEXT_OF("image", wt_topography_job, image), .value = "NAME",
     .unset = "the first image of heights", .flags = PARAM_NO_CASE,
     .help = "which image of a file: a part of its name, such as backward"},
    {PARAM("end", wt_topography_job, end, WT_Q_WAVENUMBER, ABOVE(0)), .value = "Q",
     .unset = "the end of the reliable range",
     .help = SUCH_AS("largest wavenumber of the spectrum, ", "1e8rad/m",
                     "; beyond the reliable range it follows its self-affine law")},
    {PARAM("end-slope", wt_topography_job, end_slope, WT_Q_NONE, ABOVE(0)), .value = "X",
     .unset = "",
     .help =
         SUCH_AS("end it where the rms slope reaches this, ", "1.3", ", by its law if it must be")},
    {PARAM_FLAG_OF("heights", wt_topography_job, heights), .flags = PARAM_NO_CASE,
     .help = "the tables height_map and height_profile, too: heights less their form, thinned, of "
             "which weartrack report makes figures"},
};
PARAM_TABLE(wt_topography_job_params, wt_topography_job, rows, wt_topography_job_defaults, NO_PARTS)

/* ---- scans ----------------------------------------------------------------------------------- */

/* Removes the artefacts of the scanner, and says what was found. */
static void condition_scan(const wt_topography_job *job, const wt_job *work, const char *file,
                           double *z, wt_height_map *map)
{
    const bool mend = job->scan_lines == WT_SCAN_LINES_MEND;
    const char *const keep = mend ? "--scan-lines keep" : NULL;
    const scan_line_faults found = surface_scan_lines(z, map, mend);
    if (found.scars > 0)
        wt_log_action(
            work->log, WT_WARNING, mend ? WT_CORRECTED : WT_IMPLAUSIBLE, found.scars, keep, file,
            NULL,
            "scars: %zu parts of scan lines stand out from the lines before and behind them%s",
            found.scars,
            mend ? "; they are replaced by the mean of these lines (--scan-lines keep "
                   "leaves them)"
                 : " and raise the spectrum");
    if (found.offsets > 0)
        wt_log_action(
            work->log, WT_WARNING, mend ? WT_CORRECTED : WT_IMPLAUSIBLE, 0, keep, file, NULL,
            "the scan lines have random offsets of %.3g nm (standard deviation)%s",
            1e9 * found.offsets,
            mend ? "; each line loses its mean, and waves across the lines are left out of "
                   "the spectrum (--scan-lines keep leaves the offsets)"
                 : ", which raise the spectrum");
    else if (found.suspected)
        wt_log_action(
            work->log, WT_WARNING, WT_IMPLAUSIBLE, 0, NULL, file, NULL,
            "adjacent scan lines differ more than adjacent columns do: a texture along the "
            "lines, or a drift of the scanner, which raises the spectrum; scan the surface "
            "again at 90 degrees to distinguish them");
}

/* Measures one of the files. */
static wt_status measure_scan(const wt_topography_job *job, const wt_job *work, flow_file *file,
                              size_t n_files, surface_scan *to, wt_error *err)
{
    wt_image image = {.values = NULL};
    wt_status status =
        flow_heights_read(file, job->image, true, WT_ROLE_TOPOGRAPHY, work, &image, err);
    if (status == WT_OK)
        status = flow_check_copy(
            file, flow_hash_samples(0, image.values, image.n_columns * image.n_rows), work);
    if (status != WT_OK) {
        wt_image_clear(&image);
        return status;
    }
    *to = (surface_scan){.name = file->name, .map = wt_image_height_map(&image)};
    snprintf(to->image, sizeof to->image, "%s", image.name);
    condition_scan(job, work, file->name, image.values, &to->map);
    status = wt_surface_analyse(&to->map, &job->options, &to->heights, &to->spectrum, err);
    if (status == WT_OK && job->heights) {
        status = surface_view_create(&to->map, job->options.form, n_files, &to->view, err);
        if (status != WT_OK)
            wt_surface_spectrum_clear(&to->spectrum);
    }
    if (status != WT_OK)
        wt_error_file(err, file->name);
    wt_image_clear(&image);
    to->map.z = NULL;
    if (status != WT_OK)
        return status;
    to->missing_share = (double)to->heights.missing / (double)to->heights.n;
    to->directions = wt_surface_anisotropy_fit(&to->spectrum, 2);
    if (to->missing_share > missing_share_limit)
        wt_log_add(work->log, WT_WARNING, file->name, NULL,
                   "%s of the heights are missing; they are filled smoothly, so that "
                   "short waves are too low there",
                   format_percent(to->missing_share).text);
    return WT_OK;
}

static wt_status measure_scans(const wt_topography_job *job, const wt_job *work,
                               const flow_files *files, surface_scan *scans, size_t *n,
                               wt_error *err)
{
    wt_status status = WT_OK;
    size_t n_failed = 0;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        status = measure_scan(job, work, &files->file[i], files->n, &scans[*n], &failure);
        if (status == WT_OK) {
            (*n)++;
        } else if (flow_skip_file(work, &files->file[i], &failure)) {
            status = WT_OK;
        } else {
            n_failed++;
            status = wt_job_add_failure(work, files->file[i].name, status, &failure, err);
        }
    }
    if (status == WT_OK && *n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no file has heights of a surface");
        flow_error_add_files(files, n_failed, err);
    }
    return status;
}

/* ---- combined spectrum ----------------------------------------------------------------------- */

static void warn_profiles(const surface_result *w, const wt_job *work)
{
    if (w->n_profiles > 0 && isnan(w->directions.amplitude))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the spectrum of profiles assumes a surface that is the same in all "
                   "directions; a height map would test it");
    else if (w->n_profiles > 0 && surface_is_anisotropic(&w->directions))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the spectrum of profiles assumes a surface that is the same in all "
                   "directions, which it is not by the height maps");
    if (surface_profiles_disagree(w))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the profiles and the height maps disagree: where both have data, the "
                   "density by the profiles is %.2g of that by the maps (95 %%: %s); check "
                   "that they are of one surface, and leave out those that are not",
                   w->profiles_ratio.value,
                   format_range(w->profiles_ratio.low, w->profiles_ratio.high, 2).text);
}

static void warn_surface(const surface_result *w, size_t n, const wt_job *work)
{
    warn_profiles(w, work);
    if (n == 1)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "one scan: the scatter between places of the surface is not known, and no "
                   "error contains it; scan several places");
    if (w->directions.amplitude > least_anisotropy && surface_is_anisotropic(&w->directions))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the surface is not the same in all directions: the density varies by %.0f "
                   "%% about its mean, which is reported; friction is computed with the mean",
                   100 * w->directions.amplitude);
    /* a self-affine surface has exponents of 0 to 1 (Mandelbrot, Phys. Scr. 32 (1985) 257) */
    if (w->law.found && (w->law.hurst.low > 1 || w->law.hurst.high < 0))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the Hurst exponent, %.3g, is outside 0 to 1 by more than its error: %s",
                   w->law.hurst.value,
                   w->law.hurst.low > 1
                       ? "short waves are too low, as a blunt tip or a filter leaves them; "
                         "check whether the heights were filtered, or scan with a sharper tip"
                       : "short waves are too high, as noise of the height leaves them; scan "
                         "more slowly, or combine several sizes");
}

wt_status wt_topography_compute(const wt_topography_job *job, const wt_job *work,
                                wt_topography_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of a surface");
    flow_files files = {0};
    surface_result whole = {.steep = (double)NAN};
    surface_scan *scans = NULL;
    size_t n = 0;
    wt_status status = param_check(wt_topography_job_params(), job, err);
    if (status == WT_OK && !isnan(job->end) && !isnan(job->end_slope))
        status = wt_fail(err, WT_E_ARG, "end and end-slope: the spectrum has one end");
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK) {
        scans = wt_alloc(files.n, sizeof *scans);
        status = measure_scans(job, work, &files, scans, &n, err);
    }
    if (status == WT_OK)
        status = surface_join_scans(scans, n, &whole, err);
    if (status == WT_OK) {
        whole.law = wt_self_affine_fit(&whole.spectrum);
        whole.directions = wt_surface_anisotropy_fit(surface_directional_spectrum(&whole), 2);
        whole.fourth = wt_surface_anisotropy_fit(surface_directional_spectrum(&whole), 4);
        warn_surface(&whole, n, work);
        status = surface_find_cutoff(job, work, &whole, err);
    }
    if (status == WT_OK)
        status =
            surface_tables_make(wt_topography_job_params(), job, scans, n, &whole, tables, err);
    cost_report(work, (cost_summary){.items = (double)n, .number = whole.rms_height});
    for (size_t i = 0; i < n; i++) {
        wt_surface_spectrum_clear(&scans[i].spectrum);
        surface_view_clear(&scans[i].view);
    }
    free(scans);
    surface_knots_clear(&whole.knots);
    wt_surface_spectrum_clear(&whole.spectrum);
    wt_surface_spectrum_clear(&whole.maps);
    flow_files_clear(&files);
    return status;
}
