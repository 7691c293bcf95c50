/* Export of the material to finite element programs: reduced Prony series, shift law and
 * vertical shift. Abaqus uses *ELASTIC or *HYPERELASTIC with MODULI=INSTANTANEOUS, *VISCOELASTIC
 * TIME=PRONY and *TRS. Ansys uses MP or TB,HYPER, TB,PRONY and TB,SHIFT. Both shift time, not
 * frequency. In Abaqus reduced time is the integral of dt/A, with log10 A = -C1 (T - T0) / (C2 +
 * T - T0), so A is aT (Analysis User's Guide, time domain viscoelasticity). In Ansys reduced
 * time is A t, with log10 A = C1 (T - T0) / (C2 + T - T0), so A is 1/aT (Material Reference,
 * time-temperature superposition). The constants are the same. Code_Aster has no such series; an
 * MFront behaviour takes the numbers from DEFI_MATERIAU. For vibrations Abaqus has
 * *VISCOELASTIC, FREQUENCY=PRONY with MODULI=LONG TERM and no temperature shift (Keywords
 * Reference).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/table/registry.h"
#include "dma/law/material.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct unit_system {
    const char *words;
    double stress, time, density; /* size of the unit in Pa, s and kg/m^3 */
} unit_systems[] = {
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

/* Material data in the units of the file. */
typedef struct fem_material {
    FILE *out;
    const char *comment; /* start of a comment line */
    wt_rubber rubber;
    table_view series, shifts_of; /* shifts_of.table is NULL if the shift factors are unknown */
    const struct unit_system *unit_system;
    const wt_fem_export_options *options;
    const char *name;
    bool incompressible;
    double nu, zero;           /* Poisson's ratio; zero of the temperature unit [K] */
    double reference;          /* reference temperature */
    double instant, long_term; /* Young's moduli */
    bool shifts;               /* c1 and c2 are set */
    double c1, c2;
    double fastest;  /* storage modulus (Young's) at the highest measured frequency */
    size_t n_levels; /* number of temperature levels; 1: the moduli do not depend on temperature */
    double *level, *factor; /* temperature and the factor on the moduli there */
} fem_material;

static void write_formatted(fem_material *s, const char *format, ...) WT_PRINTF(2, 3);
static void write_formatted(fem_material *s, const char *format, ...)
{
    va_list list;
    const locale_t before = clocale_enter();
    va_start(list, format);
    (void)vfprintf(s->out, format, list);
    va_end(list);
    clocale_leave(before);
}

/* ---- values from the tables ------------------------------------------------------------------ */

static double shear_modulus(const fem_material *s, double young)
{
    return young / (2 * (1 + s->nu));
}

static double bulk_modulus(const fem_material *s, double young)
{
    return young / (3 * (1 - 2 * s->nu));
}

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
    if (s->options->domain == WT_FEM_FREQUENCY && !(s->long_term > 0)) {
        wt_fail(err, WT_E_RANGE,
                "the series has no modulus in the end, which the frequency domain "
                "of Abaqus begins with");
        wt_error_advice(err, "give it by --prony-long-term, or leave --export-domain out");
        return WT_E_RANGE;
    }
    return WT_OK;
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
    write_formatted(
        s,
        "%sOnly %s Tj = %.6g. On the other side it is log10 aT = %.12g - C1 (T - Tj)/"
        "(C2 + T - Tj)\n%swith C1 = %.12g and C2 = %.12g (%s), which is not in the cards "
        "below.\n",
        s->comment, below ? "below" : "above", law->joint - s->zero,
        wt_shift_law_log_a(law, law->joint), s->comment, c1, c2, below ? "WLF" : "Arrhenius");
}

static void write_shift_law(fem_material *s)
{
    const wt_shift_law *law = &s->rubber.law;
    if (!s->shifts) {
        write_formatted(s, "%sNo law of the shifts: for the reference temperature alone.\n",
                        s->comment);
        return;
    }
    write_formatted(
        s,
        "%sShift: log10 aT = -C1 (T - T0)/(C2 + T - T0), relaxation times are multiplied by aT.\n",
        s->comment);
    if (law->kind == WT_LAW_ARRHENIUS)
        write_formatted(
            s, "%sThis is the Arrhenius law, %.6g kJ/mol, to which C2 = T0 in kelvin makes it.\n",
            s->comment, law->activation_energy / 1000);
    if (law->kind == WT_LAW_WLF_ARRHENIUS)
        write_other_branch(s);
    write_formatted(s, "%sThe isotherms were measured from %.6g to %.6g.\n", s->comment,
                    s->rubber.temperature_min - s->zero, s->rubber.temperature_max - s->zero);
}

static double deviation_percent(const table_view *series, prony_reduced_key key)
{
    const char *words = prony_reduced_key_text(series, key);
    double share = (double)NAN;
    if (words == NULL || !wt_number_parse(words, strlen(words), '.', &share))
        return (double)NAN;
    return 100 * share;
}

/* Writes the verdict on superposition, so that each exported file contains it. */
static void write_superposition(fem_material *s)
{
    if (s->shifts_of.table != NULL) {
        const char *verdict =
            shift_factors_key_text(&s->shifts_of, SHIFT_FACTORS_KEY_SUPERPOSITION);
        const char *route = shift_factors_key_text(&s->shifts_of, SHIFT_FACTORS_KEY_ROUTE);
        if (verdict != NULL)
            write_formatted(s, "%sTime-temperature superposition: %s.\n", s->comment, verdict);
        if (route != NULL)
            write_formatted(s, "%sShifts by: %s.\n", s->comment, route);
    }
    if (isfinite(s->fastest))
        write_formatted(
            s,
            "%sThe modulus at once is an extrapolation: at the highest frequency measured the "
            "storage modulus is %.6g,\n%sand %.2g %% of the modulus at once lies beyond it.\n",
            s->comment, s->fastest, s->comment, 100 * (1 - s->fastest / s->instant));
}

static void write_fem_header(fem_material *s)
{
    const table_view *v = &s->series;
    const wt_prony *p = &s->rubber.prony;
    write_formatted(
        s, "%sProny series of %zu terms from a dynamic mechanical analysis in %s, weartrack %s\n",
        s->comment, p->n, flow_deformation_name(p->deformation), wt_version());
    write_formatted(s, "%sUnits: %s; temperatures in %s.\n", s->comment, s->unit_system->words,
                    s->zero > 0 ? "degrees Celsius" : "kelvin");
    write_formatted(
        s,
        "%sReference temperature %.10g. Young's modulus %.6g at once, %.6g in the end; shear "
        "modulus %.6g, %.6g.\n",
        s->comment, s->reference, s->instant, s->long_term, shear_modulus(s, s->instant),
        shear_modulus(s, s->long_term));
    if (s->incompressible)
        write_formatted(s, "%sIncompressible: Poisson's ratio 0.5, no bulk modulus.\n", s->comment);
    else
        write_formatted(
            s,
            "%sPoisson's ratio %.6g at all times, so that bulk and shear modulus relax alike; "
            "bulk modulus %.6g, %.6g.\n",
            s->comment, s->nu, bulk_modulus(s, s->instant), bulk_modulus(s, s->long_term));
    write_formatted(s,
                    "%sHolds for times from %s at the reference temperature; what is faster or "
                    "slower was not measured.\n",
                    s->comment,
                    format_range(1 / p->frequency_max / s->unit_system->time,
                                 1 / p->frequency_min / s->unit_system->time, 3)
                        .text);
    write_formatted(
        s,
        "%sStorage and loss modulus are within %.2g %% and %.2g %% of the spectrum that was "
        "fitted; "
        "half of\n%stheir own 95 %% intervals where they are widest: %.2g %% and %.2g %%.\n",
        s->comment, deviation_percent(v, PRONY_REDUCED_KEY_DEVIATION_STORAGE),
        deviation_percent(v, PRONY_REDUCED_KEY_DEVIATION_LOSS), s->comment,
        deviation_percent(v, PRONY_REDUCED_KEY_INTERVAL_STORAGE),
        deviation_percent(v, PRONY_REDUCED_KEY_INTERVAL_LOSS));
    write_superposition(s);
    write_shift_law(s);
    if (s->n_levels > 1)
        write_formatted(s, "%sThe moduli at each isotherm have its vertical shift in them.\n",
                        s->comment);
    if (!(s->long_term > 0))
        write_formatted(s,
                        "%sNo long-term modulus: the material flows, and the shares add up to 1.\n",
                        s->comment);
}

/* ---- the programs ---------------------------------------------------------------------------- */

static double term_share(const fem_material *s, size_t i)
{
    return s->rubber.prony.modulus[i] / s->instant;
}

static void write_abaqus(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    const bool frequency = s->options->domain == WT_FEM_FREQUENCY;
    const char *moduli = frequency ? "LONG TERM" : "INSTANTANEOUS";
    write_formatted(s, "*MATERIAL, NAME=%s\n", s->name);
    if (!isnan(s->options->density))
        write_formatted(s, "*DENSITY\n%.12g,\n", s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        write_formatted(s, "*EXPANSION\n%.12g,\n", s->options->expansion);
    if (s->incompressible) {
        write_formatted(s, "** neo-Hooke with D1 = 0: elements with hybrid formulation\n");
        write_formatted(s, "*HYPERELASTIC, NEO HOOKE, MODULI=%s\n", moduli);
    } else {
        write_formatted(s, "*ELASTIC, MODULI=%s\n", moduli);
    }
    for (size_t i = 0; i < s->n_levels; i++) {
        const double young = (frequency ? s->long_term : s->instant) * s->factor[i];
        if (s->incompressible)
            write_formatted(s, "%.12g, 0.", shear_modulus(s, young) / 2);
        else
            write_formatted(s, "%.12g, %.12g", young, s->nu);
        if (s->n_levels > 1)
            write_formatted(s, ", %.10g", s->level[i]);
        write_formatted(s, "\n");
    }
    write_formatted(s, "*VISCOELASTIC, %s=PRONY\n", frequency ? "FREQUENCY" : "TIME");
    for (size_t i = 0; i < p->n; i++)
        write_formatted(s, "%.12g, %.12g, %.12g\n", term_share(s, i),
                        s->incompressible ? 0 : term_share(s, i), p->relaxation_time[i]);
    if (s->shifts && !frequency)
        write_formatted(s, "*TRS, DEFINITION=WLF\n%.12g, %.12g, %.12g\n", s->reference, s->c1,
                        s->c2);
}

enum { ANSYS_PAIRS = 3, ANSYS_TEMPERATURES = 6 }; /* values in one input line */

static void write_ansys_prony(fem_material *s, const char *what)
{
    const wt_prony *p = &s->rubber.prony;
    write_formatted(s, "TB,PRONY,%s,1,%zu,%s\n", s->name, p->n, what);
    for (size_t i = 0; i < p->n; i++) {
        if (i % ANSYS_PAIRS == 0)
            write_formatted(s, "TBDATA,%zu", 2 * i + 1);
        write_formatted(s, ",%.12g,%.12g", term_share(s, i), p->relaxation_time[i]);
        if ((i + 1) % ANSYS_PAIRS == 0 || i + 1 == p->n)
            write_formatted(s, "\n");
    }
}

/* Writes up to six values, starting at index i. */
static void write_ansys_row(fem_material *s, const char *command, const char *name,
                            const double *value, double scale, size_t i)
{
    const size_t last = s->n_levels - i < ANSYS_TEMPERATURES ? s->n_levels : i + ANSYS_TEMPERATURES;
    write_formatted(s, "%s%s%s%zu", command, name, *name != '\0' ? "," : "", i + 1);
    for (size_t k = i; k < last; k++)
        write_formatted(s, ",%.10g", scale * value[k]);
    write_formatted(s, "\n");
}

static void write_ansys(fem_material *s)
{
    write_formatted(s, "%s=1 ! number of the material\n", s->name);
    if (!isnan(s->options->density))
        write_formatted(s, "MP,DENS,%s,%.12g\n", s->name,
                        s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        write_formatted(s, "MP,ALPX,%s,%.12g\n", s->name, s->options->expansion);
    if (s->incompressible) {
        write_formatted(
            s, "! neo-Hooke with d = 0: elements with mixed u-P formulation (KEYOPT(6)=1)\n");
        write_formatted(s, "TB,HYPER,%s,%zu,2,NEO\n", s->name, s->n_levels);
        for (size_t i = 0; i < s->n_levels; i++) {
            if (s->n_levels > 1)
                write_formatted(s, "TBTEMP,%.10g\n", s->level[i]);
            write_formatted(s, "TBDATA,1,%.12g,0\n", shear_modulus(s, s->instant * s->factor[i]));
        }
    } else if (s->n_levels == 1) {
        write_formatted(s, "MP,EX,%s,%.12g\nMP,PRXY,%s,%.12g\n", s->name, s->instant, s->name,
                        s->nu);
    } else {
        write_formatted(s, "MPTEMP\n");
        for (size_t i = 0; i < s->n_levels; i += ANSYS_TEMPERATURES)
            write_ansys_row(s, "MPTEMP,", "", s->level, 1, i);
        for (size_t i = 0; i < s->n_levels; i += ANSYS_TEMPERATURES)
            write_ansys_row(s, "MPDATA,EX,", s->name, s->factor, s->instant, i);
        write_formatted(s, "MP,PRXY,%s,%.12g\n", s->name, s->nu);
    }
    write_ansys_prony(s, "SHEAR");
    if (!s->incompressible)
        write_ansys_prony(s, "BULK");
    if (!s->shifts)
        return;
    write_formatted(s, "! log10 A = C1 (T - T0)/(C2 + T - T0), with A = 1/aT\n");
    write_formatted(s, "TB,SHIFT,%s,1,3,WLF\nTBDATA,1,%.12g,%.12g,%.12g\n", s->name, s->reference,
                    s->c1, s->c2);
}

/* The stress of each term relaxes by its elastic law. The step is exact for a constant strain
 * rate within it. The properties are in the order of LISTE_COEF. */
static const char mfront_integrator[] =
    "@Integrator {\n"
    "  const real Tm = T + dT;\n"
    "  real lb = Lb[0];\n"
    "  for (unsigned short k = 1; k < nb; ++k) {\n"
    "    const real h = Tb[k] - Tb[k - 1];\n"
    "    lb += (Lb[k] - Lb[k - 1]) * std::min(std::max((Tm - Tb[k - 1]) / h, real(0)), real(1));\n"
    "  }\n"
    "  const real f = std::pow(real(10), lb);\n"
    "  const real a = std::pow(real(10), -C1 * (Tm - T0) / (C2 + Tm - T0));\n"
    "  const real l = Nu / ((1 + Nu) * (1 - 2 * Nu)), m = 1 / (1 + Nu);\n"
    "  const StrainStensor e = eto + deto;\n"
    "  const StressStensor h = l * trace(deto) * Stensor::Id() + m * deto;\n"
    "  real young = f * El;\n"
    "  sig = f * El * (l * trace(e) * Stensor::Id() + m * e);\n"
    "  for (unsigned short i = 0; i < nt; ++i) {\n"
    "    const real x = dt / (a * Tau[i]);\n"
    "    const real w = x > 1e-12 ? -std::expm1(-x) / x : real(1);\n"
    "    Si[i] = std::exp(-x) * Si[i] + f * Ei[i] * w * h;\n"
    "    young += f * Ei[i] * w;\n"
    "    sig += Si[i];\n"
    "  }\n"
    "  if (computeTangentOperator_)\n"
    "    Dt = young * (l * Stensor4::IxI() + m * Stensor4::Id());\n"
    "}\n";

static void write_code_aster(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    write_formatted(
        s,
        "MFRONT_SOURCE = r\"\"\"\n@DSL Default;\n@Behaviour WeartrackMaxwell;\n"
        "@IntegerConstant nt = %zu;\n@IntegerConstant nb = %zu;\n"
        "@MaterialProperty real Nu;\n@MaterialProperty stress El;\n"
        "@MaterialProperty stress Ei[%zu];\n@MaterialProperty real Tau[%zu];\n"
        "@MaterialProperty real T0;\n@MaterialProperty real C1;\n@MaterialProperty real C2;\n"
        "@MaterialProperty real Tb[%zu];\n@MaterialProperty real Lb[%zu];\n"
        "@AuxiliaryStateVariable StressStensor Si[%zu];\n"
        "@ProvidesSymmetricTangentOperator;\n%s\"\"\"\n"
        "with open(\"fort.38\", \"w\") as source:\n    source.write(MFRONT_SOURCE)\n"
        "MAXWELL = CREA_LIB_MFRONT(NOM_COMPOR=\"WeartrackMaxwell\", UNITE_MFRONT=38)\n"
        "# COMPORTEMENT=_F(RELATION=\"MFRONT\", COMPOR_MFRONT=MAXWELL, DEFORMATION=\"PETIT\")\n"
        "%s = DEFI_MATERIAU(\n    ELAS=_F(E=%.12g, NU=%.12g",
        p->n, s->n_levels, p->n, p->n, s->n_levels, s->n_levels, p->n, mfront_integrator, s->name,
        s->instant, s->nu);
    if (!isnan(s->options->density))
        write_formatted(s, ", RHO=%.12g", s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        write_formatted(s, ", ALPHA=%.12g", s->options->expansion);
    write_formatted(
        s, "),\n    MFRONT=_F(\n        LISTE_COEF=(\n            %.12g,\n            %.12g,\n",
        s->nu, s->long_term);
    for (size_t i = 0; i < p->n; i++)
        write_formatted(s, "            %.12g,\n", p->modulus[i]);
    for (size_t i = 0; i < p->n; i++)
        write_formatted(s, "            %.12g,\n", p->relaxation_time[i]);
    write_formatted(s, "            %.12g,\n            %.12g,\n            %.12g,\n", s->reference,
                    s->shifts ? s->c1 : 0, s->shifts ? s->c2 : 1e9);
    for (size_t i = 0; i < s->n_levels; i++)
        write_formatted(s, "            %.10g,\n", s->level[i]);
    for (size_t i = 0; i < s->n_levels; i++)
        write_formatted(s, "            %.12g,\n", log10(s->factor[i]));
    write_formatted(s, "        )\n    ),\n)\n");
}

static void write_prony_table(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    write_formatted(
        s, "%spoisson_ratio %.12g\n%sinstantaneous_modulus %.12g\n%slong_term_modulus %.12g\n",
        s->comment, s->nu, s->comment, s->instant, s->comment, s->long_term);
    write_formatted(s, "%sreference_temperature %.12g\n", s->comment, s->reference);
    if (!isnan(s->options->density))
        write_formatted(s, "%sdensity %.12g\n", s->comment,
                        s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        write_formatted(s, "%sthermal_expansion %.12g\n", s->comment, s->options->expansion);
    if (s->shifts)
        write_formatted(s, "%swlf_c1 %.12g\n%swlf_c2 %.12g\n", s->comment, s->c1, s->comment,
                        s->c2);
    for (size_t i = 0; s->n_levels > 1 && i < s->n_levels; i++)
        write_formatted(s, "%sfactor of the moduli at %.10g: %.12g\n", s->comment, s->level[i],
                        s->factor[i]);
    write_formatted(s, "relaxation_time\tg\tk\tyoungs_modulus\tshear_modulus\tbulk_modulus\n");
    for (size_t i = 0; i < p->n; i++) {
        const double e = p->modulus[i], k = s->incompressible ? 0 : term_share(s, i);
        write_formatted(s, "%.12g\t%.12g\t%.12g\t%.12g\t%.12g\t%.12g\n", p->relaxation_time[i],
                        term_share(s, i), k, e, shear_modulus(s, e), bulk_modulus(s, e));
    }
}

/* ---- interface ------------------------------------------------------------------------------- */

static const struct program {
    const char *name, *comment;
    void (*write)(fem_material *s);
} programs[] = {[WT_FEM_ABAQUS] = {"abaqus", "** ", write_abaqus},
                [WT_FEM_ANSYS] = {"ansys", "! ", write_ansys},
                [WT_FEM_CODE_ASTER] = {"code_aster", "# ", write_code_aster},
                [WT_FEM_TABLE] = {"table", "# ", write_prony_table}};

bool wt_fem_program_find(const char *name, size_t length, wt_fem_program *program)
{
    for (size_t i = 0; i < COUNT_OF(programs); i++)
        if (strlen(programs[i].name) == length && strncmp(programs[i].name, name, length) == 0) {
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
    const size_t most = program == WT_FEM_CODE_ASTER ? 8 : 32;
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
    if (status != WT_OK || program != WT_FEM_CODE_ASTER || options->poisson_ratio < 0.5)
        return status;
    wt_fail(err, WT_E_RANGE, "Code_Aster needs a Poisson's ratio below 0.5");
    wt_error_place(err, "poisson-ratio");
    wt_error_found(err, "%g", options->poisson_ratio);
    wt_error_advice(err, "give one, such as 0.499");
    return WT_E_RANGE;
}

wt_status wt_fem_export(FILE *out, wt_fem_program program, const wt_table *prony_reduced,
                        const wt_table *shift_factors, const wt_fem_export_options *options,
                        wt_error *err)
{
    if (out == NULL || (size_t)program >= COUNT_OF(programs))
        return wt_fail(err, WT_E_ARG, "nothing to export to");
    if (prony_reduced == NULL)
        return wt_fail(err, WT_E_MISSING,
                       "there is no series to export: the loss modulus or the "
                       "loss factor alone tells no level of the moduli");
    const wt_fem_export_options o = options != NULL ? *options : wt_fem_export_options_defaults();
    fem_material s = {.out = out,
                      .comment = programs[program].comment,
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
        programs[program].write(&s);
        if (ferror(out) != 0)
            status = wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno));
    }
    free(s.level);
    wt_rubber_clear(&s.rubber);
    return status;
}
