"""Figures laid out as the book's, and the style that all drawn files share."""
