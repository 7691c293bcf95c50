/* Sizes and places of what is public, on 64-bit systems: what a program was compiled with must fit
 * the library it meets. The promise stands at the head of base.h. If a line fails:
 * - A new field of a structure with room is taken from the front of `reserved`, which gets shorter
 *   by as many elements; then the size here stays and the last field may be named anew.
 * - Any other change breaks programs: allowed in a MINOR (from 1.0 on: MAJOR) that is not released
 *   yet, for which the new numbers are written here.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/weartrack.h"

#include <stddef.h>

#define MOVED " has changed its size or moved a field: see the head of tests/arch/layout.c"
#define FIXED(type, last, offset, size)                                                            \
    _Static_assert(offsetof(struct type, last) == (offset) && sizeof(struct type) == (size),       \
                   #type MOVED);
/* The caller fills it: it ends in room, and the last field in use stands just before. */
#define ROOM(type, last, offset, size)                                                             \
    FIXED(type, last, offset, size)                                                                \
    _Static_assert(offsetof(struct type, reserved) + sizeof(((struct type *)0)->reserved) ==       \
                       sizeof(struct type),                                                        \
                   #type " does not end in `reserved`");
/* An enumeration as far as it is written down here; new ones come after `last`. */
#define LAST(type, last, number)                                                                   \
    _Static_assert(sizeof(enum type) == 4 && last == (number),                                     \
                   #type " has been renumbered: new ones come last");

/* clang-format off: one a line */

/* base.h */
FIXED(wt_error, advice, 1316, 1572)
FIXED(wt_log_entry, count, 32, 40)
FIXED(wt_estimate, unit, 24, 32)
ROOM(wt_provenance_input, fingerprint, 104, 168)
FIXED(wt_progress, user, 8, 16)
LAST(wt_status, WT_E_INTERNAL, 19)
LAST(wt_severity, WT_LOSS, 2)
LAST(wt_quantity, WT_Q_SHEAR_COMPLEX_MODULUS, 41)

/* data.h */
ROOM(wt_channel, values, 104, 176)
ROOM(wt_segment, frequency, 64, 128)
ROOM(wt_cantilever, sensitivity_given, 17, 88)
ROOM(wt_force_curve, capacity, 144, 216)
FIXED(wt_image, values, 176, 184)
ROOM(wt_isotherm, shift_given, 192, 248)
ROOM(wt_ramp, source, 40, 232)
ROOM(wt_strain_sweep, source, 48, 240)
ROOM(wt_sweep, strain_sweeps, 48, 88)
ROOM(wt_power_spectrum, density, 24, 96)
ROOM(wt_noise_spectrum, amplitudes, 80, 152)
ROOM(wt_prony, frequency_max, 56, 128)
LAST(wt_segment_kind, WT_SEGMENT_OTHER, 4)
LAST(wt_deformation, WT_SHEAR, 1)
LAST(wt_spectrum_kind, WT_SPECTRUM_1D, 1)
LAST(wt_column_kind, WT_COLUMN_TEXT, 1)
LAST(wt_export_form, WT_EXPORT_STREAM, 3)

/* read.h */
FIXED(wt_format_info, version, 32, 40)
ROOM(wt_read_options, sheet, 72, 128)

/* model.h */
ROOM(wt_tip, radius_error, 56, 96)
FIXED(wt_wlf, c2, 16, 24)
ROOM(wt_material_law, check, 40, 104)
ROOM(wt_material, data, 32, 104)
ROOM(wt_transverse, axial_poisson, 56, 96)
ROOM(wt_roughness_law, free, 32, 104)
ROOM(wt_roughness, data, 24, 96)
LAST(wt_tip_shape, WT_TIP_PUNCH, 4)
LAST(wt_extrapolation, WT_EXTRAPOLATE_SLOPE, 1)

/* fit.h */
ROOM(wt_indent_options, fit_force_fraction_from, 104, 120)
FIXED(wt_indent_fit, interference_period, 704, 712)
FIXED(wt_curve_pool, chance, 16, 24)
FIXED(wt_depth_curve, loss_error, 104, 112)
FIXED(wt_curve_depth, loss_share, 384, 392)
ROOM(wt_group, n_rejected, 40, 96)
FIXED(wt_group_summary, median, 72, 80)
FIXED(wt_comparison, interaction_p, 376, 384)
ROOM(wt_shift_law, joint, 40, 80)
FIXED(wt_interval, high, 24, 32)
ROOM(wt_dwell_history, baseline_tilt, 88, 152)
FIXED(wt_dwell_point, fitted, 32, 40)
FIXED(wt_dwell_moduli, loss_common_error, 80, 88)
FIXED(wt_dwell, point, 2928, 4208)
FIXED(wt_modulation, mean, 72, 88)
ROOM(wt_slope_options, to, 8, 64)
FIXED(wt_contact_slope, freedom, 184, 192)
FIXED(wt_thermal, why_not, 152, 160)
FIXED(wt_fluid, viscosity, 8, 16)
LAST(wt_medium, WT_MEDIUM_WATER, 1)
FIXED(wt_sign_comparison, larger_chance, 16, 32)
FIXED(wt_worn_tip, misfit, 8, 16)
FIXED(wt_peak, why_not, 88, 96)
FIXED(wt_kraus, loss_inf, 40, 48)
FIXED(wt_payne, loss_note, 328, 336)
ROOM(wt_master_options, reference_at, 40, 104)
FIXED(wt_master_shift, note, 152, 280)
FIXED(wt_master, posterior, 1200, 1208)
FIXED(wt_common_member, moved, 72, 104)
FIXED(wt_common_point, difference, 64, 96)
FIXED(wt_common_law, points, 160, 168)
LAST(wt_common, WT_COMMON_MOVED, 2)
LAST(wt_rates_by, WT_RATES_BETWEEN, 2)
LAST(wt_unsettled, WT_RATES_TWIST, 3)
LAST(wt_curve_verdict, WT_CURVE_UNREADABLE, 15)
LAST(wt_contact_estimator, WT_CONTACT_ESTIMATORS, 5)
LAST(wt_depth_verdict, WT_DEPTH_OTHERWISE, 3)
LAST(wt_read_deformation, WT_DEFORMATION_BENDING, 3)
LAST(wt_sample_by, WT_SAMPLE_BY_FILE, 1)
LAST(wt_vertical_shift, WT_VERTICAL_TIED, 3)
LAST(wt_shift_by, WT_BY_LOSS_FACTOR, 3)
LAST(wt_reference_at, WT_REFERENCE_TAN_DELTA_PEAK, 1)
LAST(wt_law_kind, WT_LAW_JOINED, 3)
LAST(wt_superposition, WT_SUPERPOSITION_CANNOT_SAY, 2)

/* kernel.h */
ROOM(wt_layer_state, modulus_ratio, 8, 80)
ROOM(wt_softening, loss, 24, 64)
ROOM(wt_friction_options, strain_factor, 120, 168)
FIXED(wt_friction_point, reached, 152, 160)
FIXED(wt_friction_node, numerical_error, 32, 40)
ROOM(wt_energy_source, numerical_error, 40, 112)
ROOM(wt_layer_parameters, balance_only, 58, 128)
FIXED(wt_layer_balance, regime, 176, 184)
FIXED(wt_layer_point, wear_rate, 48, 56)
LAST(wt_depth_profile, WT_PROFILE_INCOMPRESSIBLE, 1)
LAST(wt_layer_regime, WT_LAYER_THICK, 2)

/* flow.h */
ROOM(wt_job, drawn, 96, 144)
LAST(wt_extra, WT_EXTRA_COMMON, 512)
LAST(wt_solid_program, WT_SOLID_TABLE, 3)
LAST(wt_solid_units, WT_SOLID_MM_KG_MS, 2)
LAST(wt_solid_temperature, WT_SOLID_KELVIN, 1)
ROOM(wt_file_set, spot, 152, 224)
ROOM(wt_spot_job, map, 280, 344)
ROOM(wt_spot_tables, spot_map, 8, 32)
ROOM(wt_dwell_tables, dwell_moduli, 16, 48)
LAST(wt_ways, WT_WAYS_RETRACT, 2)
ROOM(wt_thermal_job, sader_coefficient, 160, 240)
ROOM(wt_sensitivity_job, most_bend, 88, 144)
ROOM(wt_sensitivity_tables, sensitivity_curves, 8, 48)
ROOM(wt_convert_job, read, 8, 200)
ROOM(wt_indent_job, keep, 368, 392)
FIXED(wt_indent_tables, n_failed, 56, 64)
FIXED(wt_group_data, spots_given, 497, 504)
FIXED(wt_curve_digest, item, 8, 16)
LAST(wt_levers, WT_LEVERS_TWO, 2)
LAST(wt_common_source, WT_COMMON_RADIUS, 3)
FIXED(wt_samples, name, 8, 16)
ROOM(wt_master_job, reduction, 160, 208)
ROOM(wt_solid_options, poisson_ratio, 8, 64)
FIXED(wt_rubber_draw, log_b, 208, 216)
FIXED(wt_rubber, fit, 568, 672)
ROOM(wt_rubber_options, extrapolation, 4, 40)
ROOM(wt_zener, alpha, 24, 64)
LAST(wt_rubber_kind, WT_RUBBER_ZENER, 2)
LAST(wt_moduli, WT_MODULI_POINTS, 1)
FIXED(wt_master_tables, fit, 64, 72)
ROOM(wt_common_law_job, margin, 40, 80)
FIXED(wt_reduction, long_term, 16, 24)
FIXED(wt_zener_fit, series_aicc, 80, 88)
ROOM(wt_rubber_tables, series_draws, 24, 64)
ROOM(wt_payne_job, n_sets, 8, 80)
ROOM(wt_payne_tables, payne_sweep, 8, 48)
ROOM(wt_ramp_job, peak_points, 32, 104)
ROOM(wt_ramp_tables, moduli_at, 16, 64)
ROOM(wt_compare_job, groups_only, 169, 240)
ROOM(wt_compared, shift_factors, 16, 56)
ROOM(wt_materials_job, margin, 40, 112)
ROOM(wt_materials_tables, material_ratio, 8, 48)
FIXED(wt_compare_tables, modulus_budget, 32, 40)
ROOM(wt_surface, spectrum, 72, 232)
FIXED(wt_tables_role, instead, 16, 24)
ROOM(wt_softness, temperature, 88, 136)
ROOM(wt_softness_choice, sample, 8, 48)
ROOM(wt_sliding, strain_factor, 152, 208)
ROOM(wt_layer_known, calibration_share, 80, 128)
ROOM(wt_coverage_job, ratio_of_groups, 64, 96)
ROOM(wt_accuracy_job, repeats, 8, 80)
FIXED(wt_friction_tables, extrapolated_share, 8, 16)
ROOM(wt_layer_job, n_time, 144, 216)
FIXED(wt_layer_tables, balance, 40, 224)
ROOM(wt_run_options, n_columns, 80, 128)

/* report.h */
ROOM(wt_report_options, with_provenance, 16, 88)
FIXED(wt_figure_info, beside, 24, 32)
