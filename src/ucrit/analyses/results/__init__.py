"""What results share: tables with units, and how notebooks show them."""
