/* The cards of each finite-element program. Abaqus uses *ELASTIC or *HYPERELASTIC with
 * MODULI=INSTANTANEOUS, *VISCOELASTIC TIME=PRONY and *TRS. Ansys uses MP or TB,HYPER, TB,PRONY
 * and TB,SHIFT. Both shift time, not frequency. In Abaqus reduced time is the integral of dt/A,
 * with log10 A = -C1 (T - T0) / (C2 + T - T0), so A is aT (Analysis User's Guide, time domain
 * viscoelasticity). In Ansys reduced time is A t, with log10 A = C1 (T - T0) / (C2 + T - T0), so A
 * is 1/aT (Material Reference, time-temperature superposition). The constants are the same.
 * Code_Aster has no such series; an MFront behaviour takes the numbers from DEFI_MATERIAU. For
 * vibrations Abaqus has *VISCOELASTIC, FREQUENCY=PRONY with MODULI=LONG TERM and no temperature
 * shift (Keywords Reference). LS-DYNA has *MAT_GENERAL_VISCOELASTIC (076), shear moduli and decay
 * constants, where a constant of 0 is the long-term modulus, and an elastic bulk modulus (Keyword
 * Manual, volume II). OpenRadioss has /MAT/LAW42, whose Ogden term holds the long-term shear
 * modulus and, by Poisson's ratio, the bulk modulus (source of the starter, hm_read_mat42).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/finite_elements.h"

#include "core/base/text.h"

#include <math.h>

void fem_write(fem_material *s, const char *format, ...)
{
    va_list list;
    const locale_t before = clocale_enter();
    va_start(list, format);
    (void)vfprintf(s->out, format, list);
    va_end(list);
    clocale_leave(before);
}

double fem_shear_modulus(const fem_material *s, double young)
{
    return young / (2 * (1 + s->nu));
}

double fem_bulk_modulus(const fem_material *s, double young)
{
    return young / (3 * (1 - 2 * s->nu));
}

double fem_elastic_bulk_modulus(const fem_material *s)
{
    return fem_bulk_modulus(s, s->long_term > 0 ? s->long_term : s->instant);
}

static double term_share(const fem_material *s, size_t i)
{
    return s->rubber.prony.modulus[i] / s->instant;
}

static void write_abaqus(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    const bool frequency = s->options->domain == WT_FEM_FREQUENCY;
    const char *moduli = frequency ? "LONG TERM" : "INSTANTANEOUS";
    fem_write(s, "*MATERIAL, NAME=%s\n", s->name);
    if (!isnan(s->options->density))
        fem_write(s, "*DENSITY\n%.12g,\n", s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        fem_write(s, "*EXPANSION\n%.12g,\n", s->options->expansion);
    if (s->incompressible) {
        fem_write(s, "** neo-Hooke with D1 = 0: elements with hybrid formulation\n");
        fem_write(s, "*HYPERELASTIC, NEO HOOKE, MODULI=%s\n", moduli);
    } else {
        fem_write(s, "*ELASTIC, MODULI=%s\n", moduli);
    }
    for (size_t i = 0; i < s->n_levels; i++) {
        const double young = (frequency ? s->long_term : s->instant) * s->factor[i];
        if (s->incompressible)
            fem_write(s, "%.12g, 0.", fem_shear_modulus(s, young) / 2);
        else
            fem_write(s, "%.12g, %.12g", young, s->nu);
        if (s->n_levels > 1)
            fem_write(s, ", %.10g", s->level[i]);
        fem_write(s, "\n");
    }
    fem_write(s, "*VISCOELASTIC, %s=PRONY\n", frequency ? "FREQUENCY" : "TIME");
    for (size_t i = 0; i < p->n; i++)
        fem_write(s, "%.12g, %.12g, %.12g\n", term_share(s, i),
                  s->incompressible ? 0 : term_share(s, i), p->relaxation_time[i]);
    if (s->shifts && !frequency)
        fem_write(s, "*TRS, DEFINITION=WLF\n%.12g, %.12g, %.12g\n", s->reference, s->c1, s->c2);
}

enum { ANSYS_PAIRS = 3, ANSYS_TEMPERATURES = 6 }; /* values in one input line */

static void write_ansys_prony(fem_material *s, const char *what)
{
    const wt_prony *p = &s->rubber.prony;
    fem_write(s, "TB,PRONY,%s,1,%zu,%s\n", s->name, p->n, what);
    for (size_t i = 0; i < p->n; i++) {
        if (i % ANSYS_PAIRS == 0)
            fem_write(s, "TBDATA,%zu", 2 * i + 1);
        fem_write(s, ",%.12g,%.12g", term_share(s, i), p->relaxation_time[i]);
        if ((i + 1) % ANSYS_PAIRS == 0 || i + 1 == p->n)
            fem_write(s, "\n");
    }
}

/* Writes up to six values, starting at index i. */
static void write_ansys_row(fem_material *s, const char *command, const char *name,
                            const double *value, double scale, size_t i)
{
    const size_t last = s->n_levels - i < ANSYS_TEMPERATURES ? s->n_levels : i + ANSYS_TEMPERATURES;
    fem_write(s, "%s%s%s%zu", command, name, *name != '\0' ? "," : "", i + 1);
    for (size_t k = i; k < last; k++)
        fem_write(s, ",%.10g", scale * value[k]);
    fem_write(s, "\n");
}

static void write_ansys(fem_material *s)
{
    fem_write(s, "%s=1 ! number of the material\n", s->name);
    if (!isnan(s->options->density))
        fem_write(s, "MP,DENS,%s,%.12g\n", s->name, s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        fem_write(s, "MP,ALPX,%s,%.12g\n", s->name, s->options->expansion);
    if (s->incompressible) {
        fem_write(s, "! neo-Hooke with d = 0: elements with mixed u-P formulation (KEYOPT(6)=1)\n");
        fem_write(s, "TB,HYPER,%s,%zu,2,NEO\n", s->name, s->n_levels);
        for (size_t i = 0; i < s->n_levels; i++) {
            if (s->n_levels > 1)
                fem_write(s, "TBTEMP,%.10g\n", s->level[i]);
            fem_write(s, "TBDATA,1,%.12g,0\n", fem_shear_modulus(s, s->instant * s->factor[i]));
        }
    } else if (s->n_levels == 1) {
        fem_write(s, "MP,EX,%s,%.12g\nMP,PRXY,%s,%.12g\n", s->name, s->instant, s->name, s->nu);
    } else {
        fem_write(s, "MPTEMP\n");
        for (size_t i = 0; i < s->n_levels; i += ANSYS_TEMPERATURES)
            write_ansys_row(s, "MPTEMP,", "", s->level, 1, i);
        for (size_t i = 0; i < s->n_levels; i += ANSYS_TEMPERATURES)
            write_ansys_row(s, "MPDATA,EX,", s->name, s->factor, s->instant, i);
        fem_write(s, "MP,PRXY,%s,%.12g\n", s->name, s->nu);
    }
    write_ansys_prony(s, "SHEAR");
    if (!s->incompressible)
        write_ansys_prony(s, "BULK");
    if (!s->shifts)
        return;
    fem_write(s, "! log10 A = C1 (T - T0)/(C2 + T - T0), with A = 1/aT\n");
    fem_write(s, "TB,SHIFT,%s,1,3,WLF\nTBDATA,1,%.12g,%.12g,%.12g\n", s->name, s->reference, s->c1,
              s->c2);
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
    fem_write(
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
        fem_write(s, ", RHO=%.12g", s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        fem_write(s, ", ALPHA=%.12g", s->options->expansion);
    fem_write(s,
              "),\n    MFRONT=_F(\n        LISTE_COEF=(\n            %.12g,\n            %.12g,\n",
              s->nu, s->long_term);
    for (size_t i = 0; i < p->n; i++)
        fem_write(s, "            %.12g,\n", p->modulus[i]);
    for (size_t i = 0; i < p->n; i++)
        fem_write(s, "            %.12g,\n", p->relaxation_time[i]);
    fem_write(s, "            %.12g,\n            %.12g,\n            %.12g,\n", s->reference,
              s->shifts ? s->c1 : 0, s->shifts ? s->c2 : 1e9);
    for (size_t i = 0; i < s->n_levels; i++)
        fem_write(s, "            %.10g,\n", s->level[i]);
    for (size_t i = 0; i < s->n_levels; i++)
        fem_write(s, "            %.12g,\n", log10(s->factor[i]));
    fem_write(s, "        )\n    ),\n)\n");
}

/* Ten columns hold five digits. */
static void write_ls_dyna(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    fem_write(s, "*MAT_GENERAL_VISCOELASTIC_TITLE\n%s\n", s->name);
    fem_write(s,
              "$#     mid        ro      bulk       pcf        ef      tref         a         b\n");
    fem_write(s, "%10d%10.4e%10.4e%10d%10d%10d%10d%10d\n", 1,
              s->options->density / s->unit_system->density, fem_elastic_bulk_modulus(s), 0, 0, 0,
              0, 0);
    fem_write(s,
              "$#    lcid        nt    bstart     tramp     lcidk       ntk   bstartk    trampk\n");
    fem_write(s, "%10d%10d%10d%10d%10d%10d%10d%10d\n", 0, 0, 0, 0, 0, 0, 0, 0);
    fem_write(s, "$#      gi     betai\n");
    if (s->long_term > 0)
        fem_write(s, "%10.4e%10.4e\n", fem_shear_modulus(s, s->long_term), 0.0);
    for (size_t i = 0; i < p->n; i++)
        fem_write(s, "%10.4e%10.4e\n", fem_shear_modulus(s, p->modulus[i]),
                  1 / p->relaxation_time[i]);
}

enum { RADIOSS_VALUES = 5 }; /* in one line */

static void write_radioss_row(fem_material *s, const double *value, double scale)
{
    const size_t n = s->rubber.prony.n;
    for (size_t i = 0; i < n; i++)
        fem_write(s, "%20.12g%s", scale * value[i],
                  (i + 1) % RADIOSS_VALUES == 0 || i + 1 == n ? "\n" : "");
}

static void write_openradioss(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    const double shear = fem_shear_modulus(s, s->long_term);
    fem_write(s, "/MAT/LAW42/1\n%s\n#              RHO_I\n%20.12g\n", s->name,
              s->options->density / s->unit_system->density);
    fem_write(s, "#                 Nu           sigma_cut           funIDbulk         Fscale_bulk"
                 "         M    I_form\n");
    fem_write(s, "%20.12g%20d%20d%20d%10zu%10d\n", s->nu, 0, 0, 0, p->n, 0);
    fem_write(s, "#               mu_1\n%20.12g%20d%20d%20d%20d\n\n", shear, 0, 0, 0, 0);
    fem_write(s, "#            alpha_1\n%20d%20d%20d%20d%20d\n\n", 2, 0, 0, 0, 0);
    fem_write(s, "# G_i, five in a line, then tau_i\n");
    write_radioss_row(s, p->modulus, fem_shear_modulus(s, 1));
    write_radioss_row(s, p->relaxation_time, 1);
}

static void write_prony_table(fem_material *s)
{
    const wt_prony *p = &s->rubber.prony;
    fem_write(s,
              "%spoisson_ratio %.12g\n%sinstantaneous_modulus %.12g\n%slong_term_modulus %.12g\n",
              s->comment, s->nu, s->comment, s->instant, s->comment, s->long_term);
    fem_write(s, "%sreference_temperature %.12g\n", s->comment, s->reference);
    if (!isnan(s->options->density))
        fem_write(s, "%sdensity %.12g\n", s->comment,
                  s->options->density / s->unit_system->density);
    if (!isnan(s->options->expansion))
        fem_write(s, "%sthermal_expansion %.12g\n", s->comment, s->options->expansion);
    if (s->shifts)
        fem_write(s, "%swlf_c1 %.12g\n%swlf_c2 %.12g\n", s->comment, s->c1, s->comment, s->c2);
    for (size_t i = 0; s->n_levels > 1 && i < s->n_levels; i++)
        fem_write(s, "%sfactor of the moduli at %.10g: %.12g\n", s->comment, s->level[i],
                  s->factor[i]);
    fem_write(s, "relaxation_time\tg\tk\tyoungs_modulus\tshear_modulus\tbulk_modulus\n");
    for (size_t i = 0; i < p->n; i++) {
        const double e = p->modulus[i], k = s->incompressible ? 0 : term_share(s, i);
        fem_write(s, "%.12g\t%.12g\t%.12g\t%.12g\t%.12g\t%.12g\n", p->relaxation_time[i],
                  term_share(s, i), k, e, fem_shear_modulus(s, e), fem_bulk_modulus(s, e));
    }
}

const fem_program fem_programs[N_FEM_PROGRAMS] = {
    [WT_FEM_ABAQUS] = {"abaqus", "Abaqus", "** ", write_abaqus, .most_name = 32},
    [WT_FEM_ANSYS] = {"ansys", "Ansys", "! ", write_ansys, .most_name = 32},
    [WT_FEM_CODE_ASTER] = {"code_aster", "Code_Aster", "# ", write_code_aster, .most_name = 8,
                           .compressible = true},
    [WT_FEM_LS_DYNA] = {"ls-dyna", "LS-DYNA", "$ ", write_ls_dyna, .most_name = 32,
                        .most_terms = 18, .compressible = true, .density = true,
                        .one_temperature = true},
    [WT_FEM_OPENRADIOSS] = {"openradioss", "OpenRadioss", "# ", write_openradioss, .most_name = 32,
                            .most_terms = 100, .compressible = true, .density = true,
                            .long_term = true, .one_temperature = true},
    [WT_FEM_TABLE] = {"table", "the table", "# ", write_prony_table, .most_name = 32}};
