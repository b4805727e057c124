"""Kinds of input, one file each: ``NAME``, ``SHARE`` of the cases, ``make(chance)``. A new one is a line here."""

from fuzz.kinds import (
    campaign,
    comma_separated,
    companion_table,
    field_store,
    fit_json,
    gzipped,
    history,
    laboratory,
    tab_separated,
    units,
    workbook,
)

KINDS = {
    kind.NAME: kind
    for kind in (
        comma_separated,
        tab_separated,
        workbook,
        gzipped,
        units,
        campaign,
        fit_json,
        companion_table,
        history,
        field_store,
        laboratory,
    )
}
