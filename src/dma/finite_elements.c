/* Export of the material to finite element programs: reduced Prony series, shift law and
 * vertical shift, in the units of the file, with what the numbers hold for as comments.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/finite_elements.h"

#include "core/base/number.h"
#include "dma/sweep_input.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const fem_units unit_systems[] = {
    [WT_FEM_M_KG_S] = {"metre, kilogram, second; stress in Pa", 1, 1, 1},
    [WT_FEM_MM_T_S] = {"millimetre, tonne, second; stress in MPa", 1e6, 1, 1e12},
    [WT_FEM_MM_KG_MS] = {"millimetre, kilogram, millisecond; stress in GPa", 1e9, 1e-3, 1e9}};

wt_fem_export_options wt_fem_export_options_defaults(void)
{
    return (wt_fem_export_options){
        .poisson_ratio = 0.5, .density = (double)NAN, .expansion = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("export-units", wt_fem_export_options, units, "m-kg-s|mm-t-s|mm-kg-ms"),
     .flags = PARAM_NO_CASE,
     .help = "of the files of --export: Pa and s, MPa and s, or GPa and ms"},
    {PARAM_CHOICE_OF("export-temperature", wt_fem_export_options, temperature, "degC|K"),
     .flags = PARAM_NO_CASE, .help = "unit of the temperatures in the files of --export"},
    {PARAM_CHOICE_OF("export-domain", wt_fem_export_options, domain, "time|frequency"),
     .flags = PARAM_NO_CASE,
     .help =
         "Abaqus: *VISCOELASTIC, TIME=PRONY, or FREQUENCY=PRONY for vibrations at the reference "
         "temperature; the other programs take one file for both"},
    {PARAM_TEXT_OF("export-name", wt_fem_export_options, name), .flags = PARAM_NO_CASE,
     .value = "NAME", .unset = "RUBBER", .help = "name of the material in the files of --export"},
    {PARAM("export-density", wt_fem_export_options, density, WT_Q_MASS_DENSITY, ABOVE(0)),
     .flags = PARAM_NO_CASE, .value = "RHO", .unset = "not written",
     .help = "mass density, for the files of --export"},
    {PARAM("export-expansion", wt_fem_export_options, expansion, WT_Q_THERMAL_EXPANSION, ABOVE(0)),
     .flags = PARAM_NO_CASE, .value = "ALPHA", .unset = "not written",
     .help = "coefficient of linear thermal expansion, for the files of --export"},
    POISSON_RATIO(wt_fem_export_options),
};
PARAM_TABLE(wt_fem_export_options_params, wt_fem_export_options, rows,
            wt_fem_export_options_defaults, NO_PARTS)

/* ---- values from the tables ------------------------------------------------------------------ */

/* The Arrhenius law is a WLF law with its pole at absolute zero, for any reference temperature. */
static void arrhenius_to_wlf(double activation_energy, double about, double *c1, double *c2)
{
    *c1 = -2 * wt_arrhenius_log_shift(activation_energy, about, 2 * about);
    *c2 = about;
}

/* Sets the WLF constants. For a joined law it uses the branch at the reference temperature. */
static void set_wlf_constants(fem_material *s)
{
    const wt_shift_law *law = &s->rubber.law;
    const double reference = s->rubber.prony.reference_temperature;
    s->shifts = law->kind != WT_LAW_NONE;
    s->c1 = law->wlf.c1;
    s->c2 = law->wlf.c2;
    if (law->kind == WT_LAW_ARRHENIUS ||
        (law->kind == WT_LAW_WLF_ARRHENIUS && reference < law->joint))
        arrhenius_to_wlf(law->activation_energy, reference, &s->c1, &s->c2);
}

/* Fills the temperature levels with their factors. A reference outside the isotherms becomes a
 * level with factor 1. */
static void set_modulus_factors(fem_material *s)
{
    const wt_rubber *r = &s->rubber;
    const double reference = r->prony.reference_temperature;
    s->level = wt_alloc(2 * (r->n_vertical + 2), sizeof *s->level);
    s->factor = s->level + r->n_vertical + 2;
    if (r->n_vertical > 0 && reference < r->vertical_temperature[0]) {
        s->level[0] = reference;
        s->factor[s->n_levels++] = 1;
    }
    for (size_t i = 0; i < r->n_vertical; i++) {
        if (s->n_levels > 0 && !(r->vertical_temperature[i] > s->level[s->n_levels - 1]))
            continue; /* another isotherm at the same temperature */
        s->level[s->n_levels] = r->vertical_temperature[i];
        s->factor[s->n_levels++] = pow(10, -r->vertical_log_b[i]);
    }
    if (s->n_levels == 0 || reference > s->level[s->n_levels - 1]) {
        s->level[s->n_levels] = reference;
        s->factor[s->n_levels++] = 1;
    }
    for (size_t i = 0; i < s->n_levels; i++)
        s->level[i] -= s->zero;
}

/* Checks what the program needs of the series. */
static wt_status check_series(const fem_material *s, wt_error *err)
{
    const bool vibration = s->options->domain == WT_FEM_FREQUENCY;
    const size_t terms = s->rubber.prony.n + (s->long_term > 0);
    const size_t most = s->program->most_terms;
    if (!(s->long_term > 0) && (vibration || s->program->long_term)) {
        wt_fail(err, WT_E_RANGE, "the series has no long-term modulus, which %s requires",
                vibration ? "the frequency domain of Abaqus" : s->program->title);
        wt_error_advice(err, vibration
                                 ? "give it by --prony-long-term, or leave --export-domain out"
                                 : "give it by --prony-long-term");
        return WT_E_RANGE;
    }
    if (most == 0 || terms <= most)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "the series has too many terms for %s", s->program->title);
    wt_error_place(err, "prony-terms");
    wt_error_expected(err, "at most %zu", most - (s->long_term > 0));
    wt_error_found(err, "%zu", s->rubber.prony.n);
    wt_error_advice(err, "give --prony-terms %zu", most - (s->long_term > 0));
    return WT_E_RANGE;
}

/* Converts the series to Young's moduli in the units of the file. */
static wt_status scale_series(fem_material *s, wt_error *err)
{
    wt_prony *p = &s->rubber.prony;
    const double to_young = p->deformation == WT_SHEAR ? 2 * (1 + s->nu) : 1;
    const double scale = to_young / s->unit_system->stress;
    if (isnan(p->reference_temperature))
        return wt_fail(err, WT_E_MISSING, "the reference temperature of the series is not known");
    s->reference = p->reference_temperature - s->zero;
    s->fastest = s->instant = s->long_term = scale * p->equilibrium_modulus;
    for (size_t i = 0; i < p->n; i++) {
        const double x = pow(p->frequency_max * p->relaxation_time[i], 2);
        p->modulus[i] *= scale;
        p->relaxation_time[i] /= s->unit_system->time;
        s->instant += p->modulus[i];
        s->fastest += p->modulus[i] * x / (1 + x);
    }
    if (!(s->instant > 0))
        return wt_fail(err, WT_E_RANGE, "the series has no modulus");
    return check_series(s, err);
}

/* ---- header comments ------------------------------------------------------------------------- */

/* Writes the other branch of a joined law as a comment for a user subroutine. The programs
 * accept only one branch. */
static void write_other_branch(fem_material *s)
{
    const wt_shift_law *law = &s->rubber.law;
    const bool below = s->reference + s->zero < law->joint;
    double c1 = law->wlf.c1, c2 = law->wlf.c2;
    if (below) { /* WLF with the joint as reference */
        const double from = law->joint - law->wlf.reference_temperature;
        c1 = law->wlf.c1 * law->wlf.c2 / (law->wlf.c2 + from);
        c2 = law->wlf.c2 + from;
    } else {
        arrhenius_to_wlf(law->activation_energy, law->joint, &c1, &c2);
    }
    fem_write(s,
              "%sOnly %s Tj = %.6g. On the other side it is log10 aT = %.12g - C1 (T - Tj)/"
              "(C2 + T - Tj)\n%swith C1 = %.12g and C2 = %.12g (%s), which is not in the cards "
              "below.\n",
              s->comment, below ? "below" : "above", law->joint - s->zero,
              wt_shift_law_log_a(law, law->joint), s->comment, c1, c2, below ? "WLF" : "Arrhenius");
}

static void write_shift_law(fem_material *s)
{
    const wt_shift_law *law = &s->rubber.law;
    if (s->program->one_temperature) {
        fem_write(s,
                  "%sThe cards have no law of the shifts: they hold at the reference temperature "
                  "alone.\n",
                  s->comment);
        return;
    }
    if (!s->shifts) {
        fem_write(s, "%sNo law of the shifts: for the reference temperature alone.\n", s->comment);
        return;
    }
    fem_write(
        s,
        "%sShift: log10 aT = -C1 (T - T0)/(C2 + T - T0), relaxation times are multiplied by aT.\n",
        s->comment);
    if (law->kind == WT_LAW_ARRHENIUS)
        fem_write(
            s, "%sThis is the Arrhenius law, %.6g kJ/mol, to which C2 = T0 in kelvin makes it.\n",
            s->comment, law->activation_energy / 1000);
    if (law->kind == WT_LAW_WLF_ARRHENIUS)
        write_other_branch(s);
    fem_write(s, "%sThe isotherms were measured from %.6g to %.6g.\n", s->comment,
              s->rubber.temperature_min - s->zero, s->rubber.temperature_max - s->zero);
}

static percent_text format_deviation(const table_view *series, prony_reduced_key key)
{
    const char *words = prony_reduced_key_text(series, key);
    double share = (double)NAN;
    if (words == NULL || !wt_number_parse(words, strlen(words), '.', &share))
        share = (double)NAN;
    return format_percent(share);
}

/* Writes the verdict on superposition, so that each exported file contains it. */
static void write_superposition(fem_material *s)
{
    if (s->shifts_of.table != NULL) {
        const char *verdict =
            shift_factors_key_text(&s->shifts_of, SHIFT_FACTORS_KEY_SUPERPOSITION);
        const char *route = shift_factors_key_text(&s->shifts_of, SHIFT_FACTORS_KEY_ROUTE);
        if (verdict != NULL)
            fem_write(s, "%sTime-temperature superposition: %s.\n", s->comment, verdict);
        if (route != NULL)
            fem_write(s, "%sShifts by: %s.\n", s->comment, route);
    }
    if (isfinite(s->fastest))
        fem_write(s,
                  "%sThe instantaneous modulus is an extrapolation: at the highest frequency "
                  "measured the storage modulus is %.6g,\n%sand %s of the instantaneous modulus "
                  "lies beyond it.\n",
                  s->comment, s->fastest, s->comment,
                  format_percent(1 - s->fastest / s->instant).text);
}

static void write_fem_header(fem_material *s)
{
    const table_view *v = &s->series;
    const wt_prony *p = &s->rubber.prony;
    fem_write(
        s, "%sProny series of %zu terms from a dynamic mechanical analysis in %s, weartrack %s\n",
        s->comment, p->n, flow_deformation_name(p->deformation), wt_version());
    fem_write(s, "%sUnits: %s; temperatures in %s.\n", s->comment, s->unit_system->words,
              s->zero > 0 ? "degrees Celsius" : "kelvin");
    fem_write(s,
              "%sReference temperature %.10g. Instantaneous and long-term Young's modulus "
              "%.6g, %.6g; shear modulus %.6g, %.6g.\n",
              s->comment, s->reference, s->instant, s->long_term, fem_shear_modulus(s, s->instant),
              fem_shear_modulus(s, s->long_term));
    if (s->incompressible)
        fem_write(s, "%sIncompressible: Poisson's ratio 0.5, no bulk modulus.\n", s->comment);
    else if (s->program->one_temperature)
        fem_write(s, "%sLong-term Poisson's ratio %.6g; the bulk modulus %.6g does not relax.\n",
                  s->comment, s->nu, fem_elastic_bulk_modulus(s));
    else
        fem_write(
            s,
            "%sPoisson's ratio %.6g at all times, so that bulk and shear modulus relax alike; "
            "bulk modulus %.6g, %.6g.\n",
            s->comment, s->nu, fem_bulk_modulus(s, s->instant), fem_bulk_modulus(s, s->long_term));
    fem_write(s,
              "%sHolds for times from %s at the reference temperature; what is faster or "
              "slower was not measured.\n",
              s->comment,
              format_range(1 / p->frequency_max / s->unit_system->time,
                           1 / p->frequency_min / s->unit_system->time, 3)
                  .text);
    fem_write(s,
              "%sStorage and loss modulus are within %s and %s of the spectrum that was "
              "fitted; "
              "half of\n%stheir own 95 %% intervals where they are widest: %s and %s.\n",
              s->comment, format_deviation(v, PRONY_REDUCED_KEY_DEVIATION_STORAGE).text,
              format_deviation(v, PRONY_REDUCED_KEY_DEVIATION_LOSS).text, s->comment,
              format_deviation(v, PRONY_REDUCED_KEY_INTERVAL_STORAGE).text,
              format_deviation(v, PRONY_REDUCED_KEY_INTERVAL_LOSS).text);
    write_superposition(s);
    write_shift_law(s);
    if (s->n_levels > 1 && !s->program->one_temperature)
        fem_write(s, "%sThe moduli at each isotherm have its vertical shift in them.\n",
                  s->comment);
    if (!(s->long_term > 0))
        fem_write(s, "%sNo long-term modulus: the material flows, and the shares add up to 1.\n",
                  s->comment);
}
/* ---- interface ------------------------------------------------------------------------------- */

bool wt_fem_program_find(const char *name, size_t length, wt_fem_program *program)
{
    for (size_t i = 0; i < N_FEM_PROGRAMS; i++)
        if (strlen(fem_programs[i].name) == length &&
            strncmp(fem_programs[i].name, name, length) == 0) {
            *program = (wt_fem_program)i;
            return true;
        }
    return false;
}

/* Checks the material name. Ansys allows 32 characters for a parameter, Code_Aster 8 for a
 * concept. */
static wt_status check_material_name(wt_fem_program program, const char *name, wt_error *err)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    static const char others[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
    const size_t most = fem_programs[program].most_name;
    if (name == NULL ||
        (strspn(name, letters) > 0 && name[strspn(name, others)] == '\0' && strlen(name) <= most))
        return WT_OK;
    wt_fail(err, WT_E_ARG, "not a name of a material");
    wt_error_place(err, "export-name");
    wt_error_expected(err, "a letter, then letters, digits and '_', %zu at most", most);
    wt_error_found(err, "\"%s\"", name);
    return WT_E_ARG;
}

wt_status wt_fem_export_check(wt_fem_program program, const wt_fem_export_options *options,
                              wt_error *err)
{
    wt_status status = param_check(wt_fem_export_options_params(), options, err);
    if (status == WT_OK)
        status = check_material_name(program, options->name, err);
    if (status != WT_OK)
        return status;
    if (fem_programs[program].compressible && !(options->poisson_ratio < 0.5)) {
        wt_fail(err, WT_E_RANGE, "%s needs a Poisson's ratio below 0.5",
                fem_programs[program].title);
        wt_error_place(err, "poisson-ratio");
        wt_error_found(err, "%g", options->poisson_ratio);
        wt_error_advice(err, "give one, such as 0.499");
        return WT_E_RANGE;
    }
    if (fem_programs[program].density && isnan(options->density)) {
        wt_fail(err, WT_E_RANGE, "%s needs a mass density", fem_programs[program].title);
        wt_error_place(err, "export-density");
        wt_error_advice(err, "give one, such as 1100kg/m3");
        return WT_E_RANGE;
    }
    return WT_OK;
}

wt_status wt_fem_export(FILE *out, wt_fem_program program, const wt_table *prony_reduced,
                        const wt_table *shift_factors, const wt_fem_export_options *options,
                        wt_error *err)
{
    if (out == NULL || (size_t)program >= N_FEM_PROGRAMS)
        return wt_fail(err, WT_E_ARG, "nothing to export to");
    if (prony_reduced == NULL)
        return wt_fail(err, WT_E_MISSING,
                       "there is no series to export: the loss modulus or the loss factor "
                       "alone does not determine the level of the moduli");
    const wt_fem_export_options o = options != NULL ? *options : wt_fem_export_options_defaults();
    fem_material s = {.out = out,
                      .program = &fem_programs[program],
                      .comment = fem_programs[program].comment,
                      .options = &o,
                      .name = o.name != NULL ? o.name : "RUBBER",
                      .nu = o.poisson_ratio,
                      .incompressible = o.poisson_ratio >= 0.5,
                      .zero = o.temperature == WT_FEM_CELSIUS ? WT_ZERO_CELSIUS : 0};
    wt_status status = wt_fem_export_check(program, &o, err);
    if (status == WT_OK)
        status = table_bind(prony_reduced, &prony_reduced_schema, "", &s.series, err);
    if (status == WT_OK && shift_factors != NULL)
        status = table_bind(shift_factors, &shift_factors_schema, "", &s.shifts_of, err);
    if (status == WT_OK)
        status = wt_rubber_from_tables(
            &(wt_rubber_tables){.prony = prony_reduced, .shift_factors = shift_factors}, s.nu,
            &s.rubber, err);
    if (status == WT_OK) {
        s.unit_system = &unit_systems[o.units];
        set_wlf_constants(&s);
        status = scale_series(&s, err);
    }
    if (status == WT_OK) {
        set_modulus_factors(&s);
        write_fem_header(&s);
        fem_programs[program].write(&s);
        if (ferror(out) != 0)
            status = wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno));
    }
    free(s.level);
    wt_rubber_clear(&s.rubber);
    return status;
}
