/* Material, roughness and load of one replicate of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "core/base/number.h"
#include "core/base/shared_params.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/registry.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"
#include "friction/numerics/friction_kernel.h"
#include "friction/numerics/layered_moduli.h"
#include "job/cost.h"
#include "job/random_draws.h"
#include "weartrack/friction.h"

#include <math.h>
#include <string.h>

wt_sliding wt_sliding_defaults(void)
{
    return (wt_sliding){
        .pressure = {(double)NAN, 0, 0, "Pa"},
        .temperature = {(double)NAN, 0, 0, "K"},
        .shear_stress = {(double)NAN, 0, 0, "Pa"},
        .gamma = wt_friction_defaults().gamma,
        .reference_velocity = (double)NAN,
        .strain_factor = wt_friction_defaults().strain_factor,
        .flash = wt_flash_defaults(),
    };
}

static const wt_param rows[] = {
    {PARAM("pressure", wt_sliding, pressure, WT_Q_PRESSURE, ABOVE(0)), .value = "P", .letter = 'p',
     .flags = PARAM_REQUIRED,
     .help = SUCH_AS("nominal pressure, ", "0.4MPa", " or \"0.4MPa +- 5%\"")},
    {PARAM_LIST_OF("velocity", wt_sliding, velocity, n_velocity, WT_Q_VELOCITY, ABOVE(0)),
     .value = "V", .letter = 'v', .flags = PARAM_REQUIRED,
     .help = "0.3m/s, a list 1mm/s,1cm/s or a range 1e-4:10m/s:log:40 (or lin) of 40 values"},
    {PARAM("reference-velocity", wt_sliding, reference_velocity, WT_Q_VELOCITY, ABOVE(0)),
     .unset = "that of the layer, else the middle of the list", .flags = PARAM_NO_OPTION,
     .help = "velocity of the answer"},
    {PARAM("sliding-temperature", wt_sliding, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .letter = 't', .unset = "the reference temperature of the material",
     .help = "of the rubber while it slides, or of its surroundings with a flash temperature; "
             "another one than the reference needs a WLF law"},
    {PARAM("shear-stress", wt_sliding, shear_stress, WT_Q_STRESS, AT_LEAST(0)), .value = "TAU",
     .unset = "",
     .help =
         SUCH_AS("tau_f of the real contact, ", "5MPa", "; without it there is no total friction")},
    FRICTION_GAMMA(wt_sliding),
    FRICTION_STRAIN_FACTOR(wt_sliding),
    {PARAM_FLAG_OF("decades", wt_sliding, decades),
     .help = "also the contribution of each decade of the wavenumber to the friction"},
    FLASH_ROWS(wt_sliding, flash.),
};
PARAM_TABLE(wt_sliding_params, wt_sliding, rows, wt_sliding_defaults, NO_PARTS)

/* Upper limit for a plausible pressure: tyres have less than 1 MPa, seals and bearings less than
 * 100 MPa; rubber fails above. */
static const double max_rubber_pressure = 100e6; /* [Pa] */

wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work, wt_error *err)
{
    if (sliding == NULL || sliding->rubber == NULL || sliding->surface == NULL)
        return wt_fail(err, WT_E_ARG, "sliding needs a rubber and a surface");
    wt_status status = param_check(wt_sliding_params(), sliding, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), work, err);
    if (status == WT_OK && sliding->pressure.value > max_rubber_pressure)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the nominal pressure of %.4g MPa is above the %.4g MPa that rubber bears: "
                   "check its unit",
                   1e-6 * sliding->pressure.value, 1e-6 * max_rubber_pressure);
    return status;
}

double flow_reference_velocity(const wt_sliding *sliding)
{
    return isnan(sliding->reference_velocity) ? sliding->velocity[sliding->n_velocity / 2]
                                              : sliding->reference_velocity;
}

/* Creates the workspace with the strain softening of the replicate. */
static wt_status create_workspace(const wt_sliding *sliding, wt_friction_options options,
                                  uint64_t seed, size_t replicate, sliding_contact *c,
                                  wt_error *err)
{
    wt_strain_softening strain_softening = {0};
    if (sliding->strain_softening != NULL) {
        strain_softening = strain_softening_draw(sliding->strain_softening, seed, replicate);
        options.softening = &strain_softening.table;
        options.strain_factor = sliding->strain_factor;
    }
    const wt_status status =
        wt_friction_workspace_new(c->material, c->roughness, &options, &c->workspace, err);
    wt_strain_softening_clear(&strain_softening);
    return status;
}

/* Checks the validity of the material at the frequencies of the velocities, and appends a statement
 * about it. */
static wt_status check_material_range(const wt_sliding *sliding, sliding_contact *c, wt_error *err)
{
    const wt_material_law *law = c->material->law;
    char words[256] = "";
    if (law->check == NULL)
        return WT_OK;
    const wt_status status =
        law->check(c->material, c->roughness->q0 * sliding->velocity[0],
                   c->roughness->q1 * sliding->velocity[sliding->n_velocity - 1], words, err);
    const size_t used = strlen(c->statement);
    snprintf(c->statement + used, sizeof c->statement - used, "%s%s",
             used > 0 && words[0] != '\0' ? "; " : "", words);
    return status;
}

/* Uses the cached material for the stated values, if the jobs share it. */
static wt_status use_shared_material(const wt_sliding *sliding, const wt_job *work,
                                     replicate_material *cached, sliding_contact *c, wt_error *err)
{
    const double *v = sliding->velocity, reference = flow_reference_velocity(sliding);
    shared_material values;
    const wt_status status =
        material_cache_get_stated(work->drawn, sliding, work->tolerance, fmin(v[0], reference),
                                  fmax(v[sliding->n_velocity - 1], reference), &values, err);
    *cached = values.content;
    snprintf(c->statement, sizeof c->statement, "%s", values.statement);
    return status;
}

wt_status sliding_contact_create(const wt_sliding *sliding, const wt_job *work, size_t replicate,
                                 wt_material_cache *shared, wt_layer_state layer,
                                 sliding_contact *contact, wt_error *err)
{
    sliding_contact c = {.cost = work->cost};
    const uint64_t seed = work->seed;
    const bool drawn = replicate != WT_NO_REPLICATE;
    double temperature =
        flow_draw_value(sliding->temperature, seed, replicate, FLOW_DRAW_TEMPERATURE);
    wt_estimate density = {1, sliding->surface->c0.standard_error / sliding->surface->c0.value, 0,
                           "1"};
    double factor = flow_draw_positive(density, seed, replicate, FLOW_DRAW_DENSITY);
    c.pressure = flow_draw_positive(sliding->pressure, seed, replicate, FLOW_DRAW_PRESSURE);
    c.shear_stress =
        flow_draw_positive(sliding->shear_stress, seed, replicate, FLOW_DRAW_SHEAR_STRESS);
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = drawn ? REPLICATE_TOLERANCE : work->tolerance;
    options.gamma = sliding->gamma;
    options.flash = sliding->flash;
    options.shift = flow_rubber_shift_law(sliding->rubber, seed, replicate);
    options.temperature = c.temperature =
        isnan(temperature) ? sliding->rubber->prony.reference_temperature : temperature;
    options.threads = drawn ? 1 : work->threads;
    options.layer = layer;
    options.skip_extrapolated_share = drawn || (layer.thickness > 0 && layer.slope.exponent == 0) ||
                                      (work->left_out & WT_EXTRA_EXTRAPOLATED_SHARE) != 0;
    replicate_material cached = {0};
    wt_status status = shared != NULL ? material_cache_get(shared, replicate, &cached, err)
                       : drawn        ? WT_OK
                                      : use_shared_material(sliding, work, &cached, &c, err);
    c.shared = cached.material != NULL;
    c.material = cached.material;
    options.series = cached.series;
    if (status == WT_OK && !c.shared)
        status = wt_rubber_material(sliding->rubber, temperature, seed, replicate, &c.material,
                                    c.statement, err);
    if (status == WT_OK)
        status = flow_surface_draw(sliding->surface, factor, seed, replicate, &c.roughness, err);
    if (status == WT_OK)
        status = check_material_range(sliding, &c, err);
    if (status == WT_OK)
        status = create_workspace(sliding, options, seed, replicate, &c, err);
    if (status != WT_OK) {
        sliding_contact_clear(&c);
        return status;
    }
    *contact = c;
    return WT_OK;
}

wt_status sliding_contact_create_stated(const wt_sliding *sliding, const wt_job *work,
                                        sliding_contact *contact, wt_error *err)
{
    wt_job alone = *work;
    alone.left_out = WT_EXTRA_ALL;
    return sliding_contact_create(sliding, &alone, WT_NO_REPLICATE, NULL,
                                  (wt_layer_state){.modulus_ratio = 1}, contact, err);
}

wt_layer_state sliding_layer_at_shear_rate(const sliding_contact *contact, wt_layer_state layer,
                                           double velocity)
{
    const double rate = fabs(velocity) / layer.thickness;
    if (contact->workspace->layer != NULL && rate > 0)
        layer.modulus_ratio = wt_friction_layer_ratio(contact->workspace, rate);
    return layer;
}

void sliding_contact_clear(sliding_contact *contact)
{
    if (contact->workspace != NULL)
        cost_add_nodes(contact->cost, friction_node_count(contact->workspace));
    wt_friction_workspace_free(contact->workspace);
    wt_roughness_free(contact->roughness);
    if (!contact->shared)
        wt_material_free(contact->material);
    *contact = (sliding_contact){0};
}

/* ---- stated layer ---------------------------------------------------------------------------- */

/* Upper limit of the number of indentation rates. */
enum { MAX_RATES = 64 };

typedef struct rate_ratio {
    double log_frequency, log_ratio, error, df; /* standard error and degrees of freedom of ln
                                                   ratio */
} rate_ratio;

typedef struct rate_ratios {
    size_t n;
    rate_ratio item[MAX_RATES];
} rate_ratios;

/* Mean ln frequency of the curves of a row, over both groups; NaN if no frequency is available. */
static double mean_log_frequency(const table_view *rates, double low, double high)
{
    const double rounding = 1e-9;
    double sum = 0, n = 0;
    for (size_t i = 0; i < rates->n_rows; i++) {
        const double rate = modulus_rate_get(rates, i, MODULUS_RATE_RATE),
                     frequency = modulus_rate_get(rates, i, MODULUS_RATE_EQUIVALENT_FREQUENCY),
                     curves = modulus_rate_get(rates, i, MODULUS_RATE_N);
        if (rate < low * (1 - rounding) || rate > high * (1 + rounding) || !(frequency > 0))
            continue;
        sum += curves * log(frequency);
        n += curves;
    }
    return n > 0 ? sum / n : (double)NAN;
}

static wt_status read_rates(const table_view *comparison, const table_view *rates, rate_ratios *r,
                            wt_error *err)
{
    for (size_t i = 0; i < comparison->n_rows; i++) {
        const double low = comparison_get(comparison, i, COMPARISON_RATE_LOW),
                     high = comparison_get(comparison, i, COMPARISON_RATE_HIGH),
                     ratio_low = comparison_get(comparison, i, COMPARISON_RATIO_LOW),
                     ratio_high = comparison_get(comparison, i, COMPARISON_RATIO_HIGH),
                     welch_df = comparison_get(comparison, i, COMPARISON_WELCH_DF),
                     df = isnan(welch_df) ? (double)INFINITY : welch_df;
        const rate_ratio entry = {.log_frequency = mean_log_frequency(rates, low, high),
                                  .log_ratio = log(comparison_get(comparison, i, COMPARISON_RATIO)),
                                  .error =
                                      log(ratio_high / ratio_low) / 2 / students_t_quantile(df),
                                  .df = df};
        if (!isfinite(entry.log_frequency) || !isfinite(entry.log_ratio) || !(entry.error > 0))
            continue;
        if (r->n == MAX_RATES) {
            wt_fail(err, WT_E_RANGE, "a comparison at more indentation rates than can be");
            wt_error_expected(err, "at most %d", MAX_RATES);
            return WT_E_RANGE;
        }
        r->item[r->n++] = entry;
    }
    return WT_OK;
}

/* Weighted linear fit through the rates. The error of the slope has the effective degrees of
 * freedom of the errors of the points. It is enlarged if the points scatter more than their errors.
 * Systematic errors that all rates share (spots, cantilevers) do not change the slope, so that the
 * error is conservative. */
static void fit_slope(const rate_ratios *r, double *slope, double *error)
{
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0, chi = 0;
    t_error part[MAX_RATES];
    for (size_t i = 0; i < r->n; i++) {
        const double weight = 1 / (r->item[i].error * r->item[i].error);
        w += weight;
        wx += weight * r->item[i].log_frequency;
        wy += weight * r->item[i].log_ratio;
    }
    const double x0 = wx / w, y0 = wy / w;
    for (size_t i = 0; i < r->n; i++) {
        const double weight = 1 / (r->item[i].error * r->item[i].error),
                     x = r->item[i].log_frequency - x0;
        wxx += weight * x * x;
        wxy += weight * x * (r->item[i].log_ratio - y0);
    }
    *slope = wxy / wxx;
    for (size_t i = 0; i < r->n; i++) {
        const double x = r->item[i].log_frequency - x0;
        const double off = (r->item[i].log_ratio - y0 - *slope * x) / r->item[i].error;
        chi += off * off;
        part[i] = (t_error){fabs(x) / (r->item[i].error * wxx), r->item[i].df};
    }
    const t_error all = t_error_sum(part, r->n);
    const double scatter = r->n > 2 ? fmax(1, chi / (double)(r->n - 2)) : 1;
    *error = all.error * sqrt(scatter) * students_t_quantile(all.df) / NORMAL_95;
}

static wt_status set_ratio_slope(const rate_ratios *r, wt_layer_observation *observation,
                                 wt_error *err)
{
    double low = (double)INFINITY, high = -(double)INFINITY, sum = 0;
    for (size_t i = 0; i < r->n; i++) {
        low = fmin(low, r->item[i].log_frequency);
        high = fmax(high, r->item[i].log_frequency);
        sum += r->item[i].log_frequency;
    }
    if (!(high > low)) {
        wt_fail(err, WT_E_MISSING, "the modulus ratio is known at one indentation rate only");
        wt_error_expected(err, "bulk and track compared at two rates or more, with intervals");
        wt_error_found(err, "%zu with an interval and a frequency", r->n);
        wt_error_advice(err, "measure both groups at another rate, three spots each; or leave out "
                             "that the ratio goes with the rate");
        return WT_E_MISSING;
    }
    observation->ratio_slope = (wt_estimate){.unit = "1"};
    fit_slope(r, &observation->ratio_slope.value, &observation->ratio_slope.standard_error);
    observation->ratio_frequency = exp(sum / (double)r->n); /* each spot has all rates */
    observation->ratio_lowest = exp(low);
    observation->ratio_highest = exp(high);
    return WT_OK;
}

wt_status wt_layer_observation_from_rates(const wt_table *comparison, const wt_table *modulus_rate,
                                          wt_layer_observation *observation, wt_error *err)
{
    table_view c, m;
    rate_ratios r = {.n = 0};
    if (comparison == NULL || modulus_rate == NULL || observation == NULL) {
        wt_fail(err, WT_E_MISSING, "no comparison of wear track and bulk at several rates");
        wt_error_advice(err, "a ratio by rate needs curves of both at several rates; ratio-slope, "
                             "ratio-frequency, ratio-lowest and ratio-highest give it otherwise");
        return WT_E_MISSING;
    }
    wt_status status = table_bind(comparison, &comparison_schema, "", &c, err);
    if (status == WT_OK)
        status = table_bind(modulus_rate, &modulus_rate_schema, "", &m, err);
    if (status == WT_OK)
        status = read_rates(&c, &m, &r, err);
    if (status == WT_OK)
        status = set_ratio_slope(&r, observation, err);
    if (status != WT_OK)
        return status;
    const wt_estimate ratio = comparison_value(&c, COMPARISON_KEY_MODULUS_RATIO);
    const double df = comparison_value(&c, COMPARISON_KEY_MODULUS_RATIO_DF).value;
    if (!(ratio.value > 0))
        return wt_fail(err, WT_E_MISSING, "the comparison has no modulus ratio of all rates");
    observation->modulus_ratio = ratio;
    observation->modulus_ratio.unit = "1"; /* the table uses another unit text */
    observation->modulus_ratio_df = isnan(df) ? 0 : df;
    return WT_OK;
}

wt_layer_observation wt_layer_observation_defaults(void)
{
    const double unknown = (double)NAN;
    return (wt_layer_observation){.thickness = {0, 0, 0, "m"},
                                  .modulus_ratio = {1, 0, 0, "1"},
                                  .ratio_slope = {0, 0, 0, "1"},
                                  .ratio_frequency = unknown,
                                  .ratio_lowest = unknown,
                                  .ratio_highest = unknown,
                                  .ratio_temperature = unknown};
}

static const wt_param parameter_rows[] = {
    LAYER_STATE_ROWS(wt_layer_observation, ),
    {PARAM("modulus-ratio-df", wt_layer_observation, modulus_ratio_df, WT_Q_NONE, AT_LEAST(0)),
     .value = "N", .flags = PARAM_NO_CASE,
     .help = "degrees of freedom of the error of the modulus ratio, as weartrack compare gives "
             "them; 0: a normal error"},
    /* Beyond 1 the phase alone makes a storage modulus negative. */
    {PARAM("ratio-slope", wt_layer_observation, ratio_slope, WT_Q_NONE, FROM_TO(-1, 1)),
     .value = "S", .flags = PARAM_ONLY_C,
     .help = SUCH_AS("of ln modulus ratio against ln frequency, ", "\"0.06 +- 0.02\"",
                     "; the ratio is then complex, with the phase that causality asks for "
                     "(reconstructed); 0: one ratio")},
    {PARAM("ratio-frequency", wt_layer_observation, ratio_frequency, WT_Q_ANGULAR_FREQUENCY,
           AT_LEAST(0)),
     .value = "W", .unset = "needed with a slope", .flags = PARAM_ONLY_C,
     .help = "angular frequency at which the modulus ratio is as given"},
    {PARAM("ratio-lowest", wt_layer_observation, ratio_lowest, WT_Q_ANGULAR_FREQUENCY, AT_LEAST(0)),
     .value = "W", .unset = "needed with a slope", .flags = PARAM_ONLY_C,
     .help = "lowest angular frequency measured; below it the ratio is constant"},
    {PARAM("ratio-highest", wt_layer_observation, ratio_highest, WT_Q_ANGULAR_FREQUENCY,
           AT_LEAST(0)),
     .value = "W", .unset = "needed with a slope", .flags = PARAM_ONLY_C,
     .help = "likewise, the highest one"},
    {PARAM("ratio-temperature", wt_layer_observation, ratio_temperature, WT_Q_TEMPERATURE,
           AT_LEAST(0)),
     .value = "T", .unset = "that of the sliding", .flags = PARAM_ONLY_C,
     .help =
         "of these frequencies; another one needs the shift law of the bulk, which the layer is "
         "taken to have"},
    {PARAM_FLAG_OF("ratio-by-rate", wt_layer_observation, by_rate), .flags = PARAM_NO_OPTION,
     .help = "the modulus ratio depends on the frequency as the comparison finds it at several "
             "indentation rates"},
    {PARAM_FLAG_OF("bulk-shear", wt_layer_observation, bulk_shear), .flags = PARAM_ONLY_C,
     .help = "the layer has the shear stress of the bulk, not multiplied by the modulus ratio"},
};
PARAM_TABLE(wt_layer_observation_params, wt_layer_observation, parameter_rows,
            wt_layer_observation_defaults, NO_PARTS)

/* Checks the frequencies that the slope of a modulus ratio requires. */
static wt_status check_slope(const wt_layer_observation *k, wt_error *err)
{
    if (k->ratio_slope.value == 0 && !(k->ratio_slope.standard_error > 0))
        return WT_OK;
    if (!(k->ratio_frequency > 0 && k->ratio_lowest > 0 && k->ratio_highest > 0)) {
        wt_fail(err, WT_E_MISSING, "the slope of a modulus ratio needs the frequencies of it");
        wt_error_expected(err, "ratio-frequency, ratio-lowest and ratio-highest");
        return WT_E_MISSING;
    }
    if (k->ratio_lowest <= k->ratio_frequency && k->ratio_frequency <= k->ratio_highest)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "the frequency of a modulus ratio is not among those measured");
    wt_error_expected(err, "ratio-frequency from ratio-lowest to ratio-highest");
    wt_error_found(err, "%g rad/s, measured from %g to %g rad/s", k->ratio_frequency,
                   k->ratio_lowest, k->ratio_highest);
    return WT_E_RANGE;
}

wt_status sliding_layer_check(const wt_layer_observation *observation, wt_error *err)
{
    if (observation == NULL)
        return WT_OK;
    const wt_status status = param_check(wt_layer_observation_params(), observation, err);
    return status == WT_OK ? check_slope(observation, err) : status;
}

wt_ratio_slope sliding_layer_ratio_slope(const wt_layer_observation *observation, uint64_t seed,
                                         size_t replicate)
{
    wt_ratio_slope slope = {.exponent = 0};
    if (observation == NULL || !(observation->ratio_frequency > 0))
        return slope;
    slope.exponent =
        flow_draw_value(observation->ratio_slope, seed, replicate, FLOW_DRAW_RATIO_SLOPE);
    slope.reference = observation->ratio_frequency;
    slope.low = observation->ratio_lowest;
    slope.high = observation->ratio_highest;
    const double at = observation->ratio_temperature;
    slope.temperature = at > 0 ? at : (double)NAN;
    return slope;
}

/* Widens the range by the frequencies of the waves of a contact. Waves across the sliding direction
 * have any low frequency. The search begins at the lowest measured frequency or at that of the
 * longest wave along the sliding. */
static void widen_zero_loss_range(const wt_sliding *sliding, const wt_roughness *roughness,
                                  const layer_moduli *moduli, double range[2])
{
    double slowest = HUGE_VAL, fastest = 0, found[2];
    for (size_t i = 0; i < sliding->n_velocity; i++) {
        slowest = fmin(slowest, sliding->velocity[i]);
        fastest = fmax(fastest, sliding->velocity[i]);
    }
    if (!layer_moduli_zero_loss_range(moduli,
                                      fmin(moduli->layer.slope.low, roughness->q0 * slowest),
                                      roughness->q1 * fastest, found))
        return;
    range[0] = fmin(range[0], found[0]);
    range[1] = fmax(range[1], found[1]);
}

wt_status sliding_layer_zero_loss_range(const wt_sliding *sliding,
                                        const wt_layer_observation *observation, const wt_job *work,
                                        double range[2], wt_error *err)
{
    const double reference = sliding->rubber->prony.reference_temperature,
                 temperature = sliding->temperature.value;
    const wt_shift_law law = flow_rubber_shift_law(sliding->rubber, work->seed, WT_NO_REPLICATE);
    wt_layer_state layer = {
        .thickness = 1,
        .modulus_ratio = 1,
        .slope = sliding_layer_ratio_slope(observation, work->seed, WT_NO_REPLICATE)};
    wt_material *bulk = NULL;
    wt_roughness *roughness = NULL;
    if (layer.slope.exponent == 0)
        return WT_OK;
    wt_status status = wt_rubber_material(sliding->rubber, temperature, work->seed, WT_NO_REPLICATE,
                                          &bulk, NULL, err);
    if (status == WT_OK)
        status = wt_surface_roughness(sliding->surface, 1, &roughness, err);
    if (status == WT_OK)
        status = layer_slope_shift(&law, isnan(temperature) ? reference : temperature, &layer.slope,
                                   err);
    if (status == WT_OK) {
        const layer_moduli moduli = layer_moduli_create(bulk, layer, work->tolerance);
        widen_zero_loss_range(sliding, roughness, &moduli, range);
    }
    wt_roughness_free(roughness);
    wt_material_free(bulk);
    return status;
}

/* Writes the frequency dependence of the modulus ratio, and warns if its loss modulus is set to 0.
 */
static void describe_slope(const wt_layer_observation *observation, const double range[2],
                           wt_log *log, char *text, size_t size)
{
    char warning[128] = "";
    if (range[0] > 0)
        clocale_print(warning, sizeof warning,
                      "from %s rad/s its loss modulus would be below 0 by such a slope, and is "
                      "taken as 0",
                      format_range(range[0], range[1], 2).text);
    clocale_print(text, size,
                  "%.4g times those of the bulk at %.3g rad/s, as omega^%.3g with the phase of a "
                  "causal ratio (reconstructed) from %s rad/s, constant outside; "
                  "sheared at the frequency velocity over thickness%s%s",
                  observation->modulus_ratio.value, observation->ratio_frequency,
                  observation->ratio_slope.value,
                  format_range(observation->ratio_lowest, observation->ratio_highest, 3).text,
                  warning[0] != '\0' ? "; " : "", warning);
    if (warning[0] != '\0')
        wt_log_add(log, WT_WARNING, NULL, NULL, "layer: %s", warning);
}

void sliding_layer_describe(const wt_layer_observation *observation, const double range[2],
                            wt_log *log, char *text, size_t size)
{
    text[0] = '\0';
    if (observation->ratio_slope.value != 0 || observation->ratio_slope.standard_error > 0)
        describe_slope(observation, range, log, text, size);
}

wt_layer_state sliding_layer_state(const wt_layer_observation *observation, uint64_t seed,
                                   size_t replicate)
{
    wt_layer_state state = {.modulus_ratio = 1};
    if (observation == NULL)
        return state;
    const double thickness =
        flow_draw_value(observation->thickness, seed, replicate, FLOW_DRAW_THICKNESS);
    state.thickness = thickness > 0 ? thickness : 0;
    if (state.thickness > 0)
        state.modulus_ratio =
            flow_draw_positive_t(observation->modulus_ratio, observation->modulus_ratio_df, seed,
                                 replicate, FLOW_DRAW_RATIO);
    state.slope = sliding_layer_ratio_slope(observation, seed, replicate);
    return state;
}

double sliding_layer_shear_stress(const wt_layer_observation *observation, double bulk,
                                  wt_layer_state layer)
{
    const bool scaled = observation != NULL && !observation->bulk_shear && layer.thickness > 0;
    return scaled ? bulk * layer.modulus_ratio : bulk;
}
