"""Bags from bags: compare two, save a damaged one."""
