/* A result with every table a case can give, made from formulas: for the tests of the report and
 * of what passes results on. Deterministic; the numbers are plausible, not measured.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_REPORT_FIXTURE_H
#define WT_TESTS_REPORT_FIXTURE_H

#include "weartrack/data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A path that means harm to HTML, to a shell and to gnuplot. */
#define FIXTURE_EVIL "<b>'`touch fixture_was_run`\"&;$(rm -r x)\\"

/* A fixture that cannot be made is a broken test, not a failed one. */
static inline void fixture_check(wt_status status)
{
    if (status != WT_OK)
        abort();
}

/* Columns as "name:unit name:unit ..."; unit "T" is text. */
static inline wt_table *fixture_table(const char *name, const char *title, const char *columns)
{
    wt_table *table = wt_table_new(name, title);
    char *copy = strdup(columns), *rest = NULL;
    if (table == NULL || copy == NULL)
        abort();
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        char *unit = strchr(word, ':');
        *unit++ = '\0';
        if (strcmp(unit, "T") == 0)
            fixture_check(wt_table_add_text_column(table, word, word, NULL));
        else
            fixture_check(wt_table_add_column(table, word, unit, word, NULL));
    }
    free(copy);
    return table;
}

static inline void fixture_row(wt_table *table)
{
    fixture_check(wt_table_add_row(table, NULL));
}

static inline void fixture_put(wt_table *table, const char *column, double value)
{
    wt_table_put(table, (size_t)wt_table_find(table, column), value);
}

static inline void fixture_text(wt_table *table, const char *column, const char *text)
{
    fixture_check(wt_table_put_text(table, (size_t)wt_table_find(table, column), text, NULL));
}

static inline void fixture_key(wt_table *table, const char *key, double value, double standard,
                               double numerical, const char *unit)
{
    fixture_check(
        wt_table_set_estimate(table, key, (wt_estimate){value, standard, numerical, unit}, NULL));
}

static inline void fixture_words(wt_table *table, const char *key, const char *words)
{
    fixture_check(wt_table_set_key(table, key, words, NULL));
}

static inline void fixture_add(wt_result *result, wt_table *table)
{
    fixture_check(wt_result_add(result, table, NULL));
}

/* About normal: the sum of three numbers from a linear congruential generator. */
static inline double fixture_noise(uint64_t *state)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        *state = *state * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(*state >> 11) / 9007199254740992.0 - 0.5;
    }
    return 2 * sum;
}

static const char *const fixture_group[] = {"bulk", "track"};
static const double fixture_modulus[] = {20.05e6, 12.79e6};

/* ---- indentation ------------------------------------------------------------------------------
 */

static inline void fixture_indentation(wt_result *result, int group)
{
    char name[64], file[160];
    uint64_t state = 17 + (uint64_t)group;
    (void)snprintf(name, sizeof name, "indentation/%s", fixture_group[group]);
    wt_table *t = fixture_table(
        name, "Indentation",
        "file:T curve:1 spot:T x:m y:m verdict:T reason:T modulus:Pa modulus_standard_error:Pa "
        "contact_point:m contact_point_standard_error:m indentation_rate:m/s");
    for (int i = 0; i < 36; i++) {
        bool bad = i % 9 == 4;
        (void)snprintf(file, sizeof file, "%s/map.jpk-force-map%s", fixture_group[group],
                       group == 1 ? FIXTURE_EVIL : "");
        fixture_row(t);
        fixture_text(t, "file", file);
        fixture_put(t, "curve", i);
        fixture_text(t, "spot", i < 12 ? "left" : i < 24 ? "middle" : "right");
        fixture_put(t, "x", 1.5e-6 * (i % 6));
        fixture_put(t, "y", 1.5e-6 * (i / 6));
        fixture_text(t, "verdict", bad ? "poor_fit" : "accepted");
        fixture_text(t, "reason", bad ? "R^2 0.71 below 0.90 <i>" : "accepted");
        double modulus = fixture_modulus[group] * exp(0.11 * fixture_noise(&state));
        fixture_put(t, "modulus", bad ? (double)NAN : modulus);
        fixture_put(t, "modulus_standard_error", 0.03 * modulus);
        fixture_put(t, "contact_point", 1.2e-6 + 1e-9 * i);
        fixture_put(t, "contact_point_standard_error", 2.1e-9);
        fixture_put(t, "indentation_rate", 1e-7 * pow(10, i % 5 / 2.0));
    }
    fixture_words(t, "tip", "pyramid, half-angle 35.0°, radius 20 nm");
    fixture_words(t, "poisson_ratio", "0.5");
    fixture_key(t, "spring_constant", 0.1, 0.006, 0, "N/m");
    fixture_words(t, "n_accepted", "32");
    fixture_words(t, "n_rejected", "4");
    fixture_add(result, t);
}

/* A cantilever of 0.1 N/m pressing a sharp pyramid into each group. */
static inline void fixture_curves(wt_result *result)
{
    wt_table *fd = fixture_table("force_displacement", "Force against displacement",
                                 "group:T segment:T displacement:m force:N");
    wt_table *fi = fixture_table("force_indentation", "Force against indentation",
                                 "group:T indentation:m force:N fitted_force:N");
    uint64_t state = 5;
    for (int g = 0; g < 2; g++) {
        double stiffness = fixture_modulus[g] * 0.66;
        if (g > 0) {
            fixture_check(wt_table_new_block(fd, NULL));
            fixture_check(wt_table_new_block(fi, NULL));
        }
        for (int back = 0; back < 2; back++)
            for (int i = 0; i <= 1500; i++) {
                double s = (back ? 1500 - i : i) / 1500.0, delta = 130e-9 * s - 52e-9;
                double force = delta > 0 ? stiffness * delta * delta : 0;
                double pull = back && delta < 6e-9 && delta > -14e-9 ? -2.4e-9 : 0;
                double shown = force * (back ? 0.93 : 1) + pull + 0.12e-9 * fixture_noise(&state);
                fixture_row(fd);
                fixture_text(fd, "group", fixture_group[g]);
                fixture_text(fd, "segment", back ? "retract" : "approach");
                fixture_put(fd, "displacement", delta > 0 ? delta + force / 0.1 : 8 * delta);
                fixture_put(fd, "force", shown);
                if (back || delta < 0)
                    continue;
                fixture_row(fi);
                fixture_text(fi, "group", fixture_group[g]);
                fixture_put(fi, "indentation", delta);
                fixture_put(fi, "force", shown);
                fixture_put(fi, "fitted_force", force);
            }
        char key[64];
        (void)snprintf(key, sizeof key, "contact_point_%s", fixture_group[g]);
        fixture_key(fd, key, 0, 6.1e-9, 0, "m");
        (void)snprintf(key, sizeof key, "contact_force_%s", fixture_group[g]);
        fixture_key(fd, key, 0, 2e-11, 0, "N");
        (void)snprintf(key, sizeof key, "curve_%s", fixture_group[g]);
        fixture_words(fd, key, g == 0 ? "bulk/map.jpk-force-map curve 3" : FIXTURE_EVIL " curve 7");
    }
    fixture_add(result, fd);
    fixture_add(result, fi);
}

static inline void fixture_comparison(wt_result *result)
{
    wt_table *groups = fixture_table("modulus_groups", "Modulus by group",
                                     "group:T n:1 n_rejected:1 n_spots:1 mean:Pa "
                                     "standard_deviation:Pa median:Pa geometric_mean:Pa low:Pa "
                                     "high:Pa");
    wt_table *rate = fixture_table("modulus_rate", "Modulus against rate",
                                   "group:T indentation_rate:m/s equivalent_frequency:rad/s n:1 "
                                   "geometric_mean:Pa low:Pa high:Pa");
    wt_table *dma = fixture_table("dma_comparison", "Indentation against DMA",
                                  "group:T equivalent_frequency:rad/s indentation_modulus:Pa "
                                  "low:Pa high:Pa dma_storage_modulus:Pa dma_complex_modulus:Pa "
                                  "ratio:1 extrapolated:1");
    for (int g = 0; g < 2; g++) {
        double e = fixture_modulus[g];
        fixture_row(groups);
        fixture_text(groups, "group", fixture_group[g]);
        fixture_put(groups, "n", 32);
        fixture_put(groups, "n_rejected", 4);
        fixture_put(groups, "n_spots", 3);
        fixture_put(groups, "mean", 1.01 * e);
        fixture_put(groups, "standard_deviation", 0.11 * e);
        fixture_put(groups, "median", 0.998 * e);
        fixture_put(groups, "geometric_mean", e);
        fixture_put(groups, "low", 0.93 * e);
        fixture_put(groups, "high", 1.075 * e);
        for (int i = 0; i < 5; i++) {
            double v = 1e-7 * pow(10, i / 2.0), omega = 25.2 * pow(10, i / 2.0);
            double here = e * pow(v / 1e-6, 0.06);
            fixture_row(rate);
            fixture_text(rate, "group", fixture_group[g]);
            fixture_put(rate, "indentation_rate", v);
            fixture_put(rate, "equivalent_frequency", omega);
            fixture_put(rate, "n", 6 + i % 2);
            fixture_put(rate, "geometric_mean", here);
            fixture_put(rate, "low", 0.88 * here);
            fixture_put(rate, "high", 1.14 * here);
            fixture_row(dma);
            fixture_text(dma, "group", fixture_group[g]);
            fixture_put(dma, "equivalent_frequency", omega);
            fixture_put(dma, "indentation_modulus", here);
            fixture_put(dma, "low", 0.88 * here);
            fixture_put(dma, "high", 1.14 * here);
            fixture_put(dma, "dma_storage_modulus", 16e6 * pow(omega / 100, 0.09));
            fixture_put(dma, "dma_complex_modulus", 17.1e6 * pow(omega / 100, 0.095));
            fixture_put(dma, "ratio", here / (17.1e6 * pow(omega / 100, 0.095)));
            fixture_put(dma, "extrapolated", i == 4);
        }
        if (g == 0)
            fixture_check(wt_table_new_block(rate, NULL));
    }
    fixture_add(result, groups);
    fixture_add(result, rate);
    fixture_add(result, dma);
    wt_table *t = fixture_table("comparison", "Wear track against bulk",
                                "rate_low:m/s rate_high:m/s n_bulk:1 n_track:1 ratio:1 ratio_low:1 "
                                "ratio_high:1 difference:Pa welch_t:1 welch_df:1 welch_p:1 "
                                "holm_p:1 mann_whitney_p:1 effect_size:1");
    for (int i = -1; i < 5; i++) {
        static const double row[] = {32,     32,    0.636,    0.587,   0.688,  -7.26e6,
                                     13.457, 17.17, 1.42e-10, 8.5e-10, 3.1e-6, -5.2};
        fixture_row(t);
        fixture_put(t, "rate_low", i < 0 ? (double)NAN : 1e-7 * pow(10, i / 2.0) / 1.78);
        fixture_put(t, "rate_high", i < 0 ? (double)NAN : 1e-7 * pow(10, i / 2.0) * 1.78);
        for (size_t c = 0; c < sizeof row / sizeof *row; c++)
            wt_table_put(t, c + 2, c < 2 && i >= 0 ? 6 : row[c] * (c == 8 ? 1 + i * i : 1));
    }
    fixture_words(t, "unit_of_analysis", "spot");
    fixture_key(t, "modulus_ratio", 0.636, 0.024, 0, "1");
    fixture_add(result, t);
}

/* ---- DMA --------------------------------------------------------------------------------------
 */

enum { FIXTURE_TERMS = 24 };

static inline void fixture_term(int k, double *time, double *modulus)
{
    *time = pow(10, k - 19);
    *modulus = 2.6e8 * exp(-0.5 * pow((k - 10) / 2.3, 2)) + 1.1e6;
}

static inline double fixture_log_a(double kelvin)
{
    return -12.4 * (kelvin - 293.15) / (96.3 + kelvin - 293.15);
}

static inline void fixture_dma(wt_result *result)
{
    wt_table *shift = fixture_table("shift_factors", "Shift factors",
                                    "temperature:K log_a:1 log_a_standard_error:1 log_b:1 "
                                    "log_b_standard_error:1 log_b_physical:1 correlation:1 "
                                    "overlap:1 determined:1 note:T wlf_log_a:1");
    wt_table *master = fixture_table("master_curve", "Master curve",
                                     "angular_frequency:rad/s storage_modulus:Pa loss_modulus:Pa "
                                     "temperature:K fitted_storage:Pa fitted_loss:Pa");
    wt_table *prony = fixture_table("prony", "Prony series", "relaxation_time:s modulus:Pa");
    uint64_t state = 99;
    for (int i = 0; i < 12; i++) {
        double kelvin = 258.15 + 6 * i, shift_10 = fixture_log_a(kelvin);
        double measured = shift_10 + 0.06 * fixture_noise(&state);
        fixture_row(shift);
        fixture_put(shift, "temperature", kelvin);
        fixture_put(shift, "log_a", measured);
        fixture_put(shift, "log_a_standard_error", 0.05 + 0.02 * fabs(i - 6.0));
        fixture_put(shift, "log_b", 0.004 * (i - 6));
        fixture_put(shift, "log_b_standard_error", 0.003);
        fixture_put(shift, "log_b_physical", 0.0038 * (i - 6));
        fixture_put(shift, "overlap", 0.6);
        fixture_put(shift, "determined", i != 11);
        fixture_text(shift, "note", i == 11 ? "overlap too small" : "");
        fixture_put(shift, "wlf_log_a", shift_10);
        if (i > 0)
            fixture_check(wt_table_new_block(master, NULL));
        for (int j = 0; j < 15; j++) {
            double omega = 2 * 3.141592653589793 * pow(10, -1 + 3.0 * j / 14 + shift_10);
            double storage = 6e6, loss = 0, time, modulus;
            for (int k = 0; k < FIXTURE_TERMS; k++) {
                fixture_term(k, &time, &modulus);
                double z = omega * time;
                storage += modulus * z * z / (1 + z * z);
                loss += modulus * z / (1 + z * z);
            }
            fixture_row(master);
            fixture_put(master, "angular_frequency", omega);
            fixture_put(master, "storage_modulus", storage * exp(0.02 * fixture_noise(&state)));
            fixture_put(master, "loss_modulus", loss * exp(0.03 * fixture_noise(&state)));
            fixture_put(master, "temperature", kelvin);
            fixture_put(master, "fitted_storage", storage);
            fixture_put(master, "fitted_loss", loss);
        }
    }
    for (int k = 0; k < FIXTURE_TERMS; k++) {
        double time, modulus;
        fixture_term(k, &time, &modulus);
        fixture_row(prony);
        fixture_put(prony, "relaxation_time", time);
        fixture_put(prony, "modulus", modulus);
    }
    fixture_key(shift, "wlf_c1", 12.4, 0.31, 0, "1");
    fixture_key(shift, "wlf_c2", 96.3, 2.9, 0, "K");
    fixture_words(shift, "wlf_correlation", "0.987");
    fixture_key(shift, "reference_temperature", 293.15, 0, 0, "K");
    fixture_key(shift, "pole", 196.85, 2.9, 0, "K");
    fixture_words(shift, "vertical", "physical");
    fixture_words(shift, "deformation", "tension");
    fixture_words(shift, "superposition", "holds");
    fixture_key(master, "rms_storage", 0.012, 0, 0, "1");
    fixture_key(prony, "equilibrium_modulus", 6e6, 8e4, 0, "Pa");
    fixture_key(prony, "reference_temperature", 293.15, 0, 0, "K");
    fixture_words(prony, "deformation", "tension");
    fixture_key(prony, "rms_loss", 0.021, 0, 0, "1");
    fixture_add(result, shift);
    fixture_add(result, master);
    fixture_add(result, prony);
}

/* ---- sliding ----------------------------------------------------------------------------------
 */

static inline void fixture_friction(wt_result *result)
{
    wt_table *rough = fixture_table("roughness", "Power spectrum", "wavenumber:rad/m density:m^4");
    for (int i = 0; i <= 40; i++) {
        double q = pow(10, 3 + 4.5 * i / 40);
        fixture_row(rough);
        fixture_put(rough, "wavenumber", q);
        fixture_put(rough, "density", 2e-16 * pow(fmax(q, 6e3) / 6e3, -3.7));
    }
    fixture_key(rough, "rms_height", 22.8e-6, 1.1e-6, 0, "m");
    fixture_key(rough, "rms_slope", 1.28, 0.06, 0, "1");
    fixture_add(result, rough);

    wt_table *t = fixture_table(
        "friction", "Friction",
        "velocity:m/s friction:1 friction_standard_error:1 friction_numerical_error:1 hysteresis:1 "
        "hysteresis_standard_error:1 hysteresis_numerical_error:1 adhesion:1 area_ratio:1 "
        "area_ratio_standard_error:1 area_ratio_numerical_error:1 friction_with_layer:1 "
        "friction_with_layer_standard_error:1 extrapolated_share:1");
    wt_table *area = fixture_table("contact_area", "Contact area",
                                   "velocity:m/s magnification:1 wavenumber:rad/m area_ratio:1 "
                                   "hysteresis:1");
    for (int i = 0; i <= 24; i++) {
        double v = pow(10, -4 + 5.0 * i / 24), x = log10(v);
        double hysteresis = 0.62 * exp(-0.5 * pow((x - 0.2) / 1.9, 2));
        double ratio = 0.055 * pow(v / 1e-2, -0.14), adhesion = 5e6 * ratio / 0.4e6;
        fixture_row(t);
        fixture_put(t, "velocity", v);
        fixture_put(t, "friction", hysteresis + adhesion);
        fixture_put(t, "friction_standard_error", 0.08 * hysteresis + 0.05 * adhesion);
        fixture_put(t, "friction_numerical_error", 3e-5);
        fixture_put(t, "hysteresis", hysteresis);
        fixture_put(t, "hysteresis_standard_error", 0.08 * hysteresis);
        fixture_put(t, "hysteresis_numerical_error", 2e-5 * hysteresis);
        fixture_put(t, "adhesion", adhesion);
        fixture_put(t, "area_ratio", ratio);
        fixture_put(t, "area_ratio_standard_error", 0.05 * ratio);
        fixture_put(t, "area_ratio_numerical_error", 1e-5 * ratio);
        fixture_put(t, "friction_with_layer", hysteresis + 0.7 * adhesion);
        fixture_put(t, "friction_with_layer_standard_error", 0.08 * hysteresis + 0.07 * adhesion);
        fixture_put(t, "extrapolated_share", x > 0 ? 0.04 * x : 0);
        if (i % 6 != 0)
            continue;
        if (i > 0)
            fixture_check(wt_table_new_block(area, NULL));
        for (int k = 0; k <= 45; k++) {
            double zeta = pow(10, 4.5 * k / 45);
            fixture_row(area);
            fixture_put(area, "velocity", v);
            fixture_put(area, "magnification", zeta);
            fixture_put(area, "wavenumber", 1e3 * zeta);
            fixture_put(area, "area_ratio", 1 / (1 + (1 / ratio - 1) * pow(zeta / 31623, 0.5)));
            fixture_put(area, "hysteresis", hysteresis * pow(log10(zeta) / 4.5, 1.3));
        }
    }
    fixture_key(t, "pressure", 0.4e6, 0.02e6, 0, "Pa");
    fixture_key(t, "shear_stress", 5e6, 0.5e6, 0, "Pa");
    fixture_key(t, "temperature", 293.15, 0, 0, "K");
    fixture_key(t, "layer_thickness", 1.15e-6, 0.2e-6, 0, "m");
    fixture_key(t, "reference_velocity", 0.3, 0, 0, "m/s");
    fixture_key(t, "friction_at_reference", 1.02, 0.06, 3e-5, "1");
    fixture_key(t, "hysteresis_at_reference", 0.602, 0.048, 1.2e-5, "1");
    fixture_key(t, "friction_with_layer_at_reference", 0.89, 0.06, 0, "1");
    fixture_key(t, "friction_change_at_reference", -0.13, 0.02, 0, "1");
    fixture_words(t, "standard_error_includes", "the Prony series, the pressure, C0");
    fixture_add(result, t);
    fixture_add(result, area);
}

static inline void fixture_layer(wt_result *result)
{
    wt_table *energy =
        fixture_table("energy_density", "Energy density", "depth:m energy_density:W/m^3");
    for (int i = 0; i <= 40; i++) {
        double z = pow(10, -9 + 5.0 * i / 40);
        fixture_row(energy);
        fixture_put(energy, "depth", z);
        fixture_put(energy, "energy_density", 4e11 / (1 + pow(z / 4e-8, 0.9)) * exp(-z / 3e-5));
    }
    fixture_add(result, energy);
    wt_table *t = fixture_table("layer", "Layer",
                                "time:s thickness:m thickness_standard_error:m "
                                "thickness_numerical_error:m formation_rate:m/s wear_rate:m/s");
    const double kappa = 2e6, formation = 1e-7, wear = 1e-8;
    for (int i = 0; i <= 48; i++) {
        double time = pow(10, -1 + 4.5 * i / 48), done = kappa * wear * time;
        double thickness = log1p(-expm1(-done) * (formation / wear - 1)) / kappa;
        fixture_row(t);
        fixture_put(t, "time", time);
        fixture_put(t, "thickness", time < 0.21 ? 0 : thickness);
        fixture_put(t, "thickness_standard_error", 0.18 * thickness);
        fixture_put(t, "thickness_numerical_error", 1e-15);
        fixture_put(t, "formation_rate", formation * exp(-kappa * thickness));
        fixture_put(t, "wear_rate", wear);
    }
    fixture_key(t, "balance_thickness", 1.151e-6, 0.21e-6, 2e-12, "m");
    fixture_key(t, "formation_wear_ratio", 10, 1.8, 0, "1");
    fixture_words(t, "regime", "thick");
    fixture_key(t, "incubation_time", 0.21, 0.04, 0, "s");
    fixture_key(t, "relaxation_time", 50, 9, 0, "s");
    fixture_key(t, "critical_specific_wear_rate", 2.1e-11, 3e-12, 0, "m^2/N");
    fixture_key(t, "removal_time", (double)NAN, (double)NAN, 0, "s");
    fixture_add(result, t);
}

/* ---- record -----------------------------------------------------------------------------------
 */

static inline void fixture_record(wt_result *result)
{
    wt_table *answer = fixture_table("answer", "Answer", "question:T answer:T kind:T");
    static const char *const answers[][3] = {
        {"Is there a modified layer?",
         "Yes. The wear track is softer than the bulk: its modulus is 0.64 times that of the bulk "
         "(95 % interval 0.59 to 0.69, 3 spots each).",
         "layer"},
        {"How thick will it be?",
         "1.15 µm ± 0.21 µm when formation and wear are equally fast, after about 50 s of contact.",
         "thickness"},
        {"What does it do to friction?",
         "At 0.3 m/s the friction coefficient falls from 1.02 to 0.88.", "friction"},
        {"What to keep in mind?",
         "The spring constant was not calibrated: the ratio does not depend on it, each modulus "
         "does. File " FIXTURE_EVIL " has no positions.",
         "caveat"}};
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        fixture_row(answer);
        fixture_text(answer, "question", answers[i][0]);
        fixture_text(answer, "answer", answers[i][1]);
        fixture_text(answer, "kind", answers[i][2]);
    }
    fixture_words(answer, "case_title", "EPDM, high carbon black, severe <case>");
    fixture_add(result, answer);

    wt_table *inputs =
        fixture_table("inputs", "Inputs", "path:T role:T format:T bytes:byte sha256:T");
    static const char *const paths[][3] = {{"bulk/map.jpk-force-map", "bulk", "jpk-force-map 1"},
                                           {FIXTURE_EVIL, "track", "jpk-force-map 1"},
                                           {"dma/sweep.txt", "dma", "trios-text 2"}};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        fixture_row(inputs);
        fixture_text(inputs, "path", paths[i][0]);
        fixture_text(inputs, "role", paths[i][1]);
        fixture_text(inputs, "format", paths[i][2]);
        fixture_put(inputs, "bytes", 2438121 + (double)i);
        fixture_text(inputs, "sha256",
                     "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08");
    }
    fixture_add(result, inputs);

    wt_table *failures = fixture_table("failures", "Failures", "file:T message:T");
    fixture_row(failures);
    fixture_text(failures, "file", "track/broken.jpk-force");
    fixture_text(failures, "message",
                 "file is damaged: \"segments/0\" ends after 12 of 2048 bytes "
                 "\x01\xff & <script>alert(1)</script>");
    fixture_add(result, failures);

    wt_table *notes = fixture_table("notes", "Notes", "severity:T file:T place:T text:T count:1");
    fixture_row(notes);
    fixture_text(notes, "severity", "warning");
    fixture_text(notes, "file", FIXTURE_EVIL);
    fixture_text(notes, "place", "segments/1");
    fixture_text(notes, "text", "no spring constant; the user's value is used");
    fixture_put(notes, "count", 36);
    fixture_add(result, notes);

    wt_table *cost = fixture_table("cost", "Cost",
                                   "stage:T runs:1 because:T wall_time:s cpu_time:s items:1 "
                                   "tolerance_asked:1 error_estimated:1");
    static const char *const stages[][2] = {{"indentation", "the case has force curves"},
                                            {"master curve", "friction needs the material"},
                                            {"friction", "the case has a sliding section"},
                                            {"layer", "the case has a layer section"},
                                            {"roughness", "left out: nothing asked for it"}};
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        bool runs = i < 4;
        fixture_row(cost);
        fixture_text(cost, "stage", stages[i][0]);
        fixture_put(cost, "runs", runs);
        fixture_text(cost, "because", stages[i][1]);
        fixture_put(cost, "wall_time", runs ? 0.0213 * (double)(i + 1) : (double)NAN);
        fixture_put(cost, "cpu_time", runs ? 0.0391 * (double)(i + 1) : (double)NAN);
        fixture_put(cost, "items", runs ? 72 : 0);
        fixture_put(cost, "tolerance_asked", i == 2 ? 1e-4 : (double)NAN);
        fixture_put(cost, "error_estimated", i == 2 ? 2.1e-5 : (double)NAN);
    }
    fixture_add(result, cost);

    static const char xml[] = "<?xml version=\"1.0\"?>\n<case title=\"HC &amp; severe\">\n"
                              "  <sliding pressure=\"0.4 MPa\"/>\n</case>\n";
    fixture_check(wt_result_set_case(result, xml, sizeof xml - 1, NULL));
    char program[] = "weartrack", run[] = "run", path[] = "<case>.xml";
    char *const command[] = {program, run, path, NULL};
    fixture_check(wt_provenance_set_command(wt_result_provenance(result), 3, command));
}

/* Everything; freed with wt_result_free. */
static inline wt_result *fixture_result(void)
{
    wt_result *result = wt_result_new();
    if (result == NULL)
        abort();
    fixture_record(result);
    fixture_indentation(result, 0);
    fixture_indentation(result, 1);
    fixture_curves(result);
    fixture_comparison(result);
    fixture_dma(result);
    fixture_friction(result);
    fixture_layer(result);
    return result;
}

#endif
